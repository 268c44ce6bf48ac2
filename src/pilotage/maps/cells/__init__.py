"""Divide a drawing into cells: free space, its narrowings, the pieces between them (Wolter 2001, 4.1)."""
