(class "class" @context name: (identifier) @name) @item
(enum "enum" @context name: (identifier) @name) @item
(predicate ["predicate" "action"] @context name: (identifier) @name) @item
(rule class: (identifier) @context "::" @context predicate: (identifier) @name) @item
