"""Rows of a record, and code that says what must hold in each, in; the rows in which it plainly does out."""
