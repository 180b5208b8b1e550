"""Plans and traces as text and pictures."""
