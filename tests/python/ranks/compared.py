"""Options of the meshes that are compared."""

OPTIONS = {"parts": 5, "size": 0.3}
