(block "}" @end) @indent
(enum "}" @end) @indent
(arguments ")" @end) @indent
