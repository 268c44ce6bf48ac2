"""Routes through the cells of a drawing, and places as people name them (Wolter 2001, 4.2)."""
