(block) @local.scope
(rule) @local.scope
(foreach) @local.scope

(declarator name: (identifier) @local.definition)
(parameter name: (identifier) @local.definition)
(instance name: (identifier) @local.definition)
(foreach name: (identifier) @local.definition)

(name (identifier) @local.reference)
