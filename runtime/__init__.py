"""Program in, plan and trace out."""
