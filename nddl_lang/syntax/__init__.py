"""Text in, syntax tree out, whatever the text."""
