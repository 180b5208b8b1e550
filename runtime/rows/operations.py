"""Name the operations of the row evaluator: the number, then the register or token that it is about, and more."""

STRIDE = 8  # numbers of one operation
BLOCK = 64  # rows that are evaluated together
MOST_TOKENS = 64  # of a row
MOST_GUARDS = 64  # one within the other

PARAMETER, LOCAL, TIME, OBJECT, DRAWN = 0, 1, 2, 3, 4  # what is read
COUNT, COUNT_NEAR = 5, 6
CHILD, RELATED, GUARD, OTHERWISE, END = 7, 8, 9, 10, 11
ALLOWED, WITHIN, AMONG, SAME, NEAR, OTHER, APART, AT_MOST, BELOW, ALIKE = 12, 13, 14, 15, 16, 17, 18, 19, 20, 21
ADD, SUBTRACT, MULTIPLY, LEAST, GREATEST, NEGATIVE, SIZE, ROOT, REST, SQUARE = 30, 31, 32, 33, 34, 35, 36, 37, 38, 39
FLOOR, CEILING, DISTANCE, TOWARDS = 40, 41, 42, 43
EQUAL, UNEQUAL, IS_AT_MOST, IS_BELOW, BOTH, EITHER, NEITHER = 50, 51, 52, 53, 54, 55, 56  # truth values
