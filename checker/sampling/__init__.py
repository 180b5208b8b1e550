"""Parameter ranges in, reproducible draws out."""
