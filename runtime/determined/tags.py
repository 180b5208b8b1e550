"""Name the integers in the arrays of a determined reactor: sections of its state, columns of its log, answers."""

NONE = -1
FAR = 2**51  # later than any tick
COARSE = 2.0**32  # beyond it the last places of sums come near the tolerance, where an interval engine decides
PAIRS = 64  # how many orders of ends can be kept

# Sections of `state`, one number for each timeline.
PREDICATE, START, SLOT, LEAST, MOST = 0, 1, 2, 3, 4
FOLLOWER, OWNER = 5, 6  # the block of the token that is to follow, and the timeline after whose token
ENDING, DUE = 7, 8  # during a tick: what ends now, and the block of what is due now
WISH, WISH_FROM, WISH_UNTIL = 9, 10, 11  # the block of what somebody asked for, and when it may start
WISH_END_FROM, WISH_END_UNTIL, WISH_LEAST, WISH_MOST = 12, 13, 14, 15
BEFORE = 16  # the predicate of the token before
WISH_PREDICATE = 17  # of what somebody asked for
OWN_LEAST, OWN_MOST = 18, 19  # the end of a token that somebody asked for, as its own rules bound it
SECTIONS = 20

# Columns of the log after the tick: timeline, predicate, block (started by another one: -1 - row of that), where its
# values begin; once it has been told, the index of its event and that of the cause; where what its block shows begins.
LINE, KIND, BLOCK, VALUES, EVENT, CAUSE, SHOWN = 1, 2, 3, 4, 5, 6, 7
ROW = 8
WISHED = 1 << 40  # marks the block of a token that somebody asked for

RUNS_ON, CHANGES, STOPS = 0, 1, 2  # why a machine came back

IS_TOGETHER, IS_MERGED, IS_PREVIOUS, IS_FOLLOWING = 0, 1, 2, 3  # how a token of a block is found
OF_NOBODY, OF_RULE, OF_REQUEST, OF_OBSERVATION, OF_FACT = 0, 1, 2, 3, 4  # origins of tokens
