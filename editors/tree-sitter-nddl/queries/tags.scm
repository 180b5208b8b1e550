(class name: (identifier) @name) @definition.class
(enum name: (identifier) @name) @definition.type
(predicate name: (identifier) @name) @definition.method
(rule predicate: (identifier) @name) @reference.call
(instance predicate: (name (identifier) @name)) @reference.call
(instance predicate: (path member: (identifier) @name .)) @reference.call
(new class: (identifier) @name) @reference.class
(class base: (identifier) @name) @reference.class
