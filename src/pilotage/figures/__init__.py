"""One function a picture: takes values, returns Axes."""
