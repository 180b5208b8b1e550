"""Small faults in models: made by the syntax tree, flown, and found again by explanations."""
