[
  (block)
  (enum)
  (comment)
] @fold
