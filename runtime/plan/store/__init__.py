"""The rows and tables of a plan, its marks, and its door to the engine."""
