# `goals.py` is compiled as it is.
