[
  (block)
  (enum)
  (arguments)
] @indent

["}" ")"] @outdent
