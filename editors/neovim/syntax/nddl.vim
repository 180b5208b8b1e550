" Colours for NDDL, until the language server's tokens come.
if exists("b:current_syntax")
  finish
endif

syntax keyword nddlWord action class close condition effect else enforce enum extends filter foreach if in new predicate super this typedef
syntax keyword nddlType int float bool string
syntax keyword nddlGoal goal fact rejectable
syntax keyword nddlRelation any before after meets met_by starts ends equals equal contains contained_by parallels paralleled_by
syntax keyword nddlRelation starts_before starts_after starts_before_end starts_during ends_before ends_after ends_after_start ends_during contains_start contains_end
syntax keyword nddlConstant true false inf inff
syntax match nddlNumber "\<[0-9]\+\(\.[0-9]*\)\?\([eE][-+]\?[0-9]\+\)\?\>"
syntax match nddlInclude "^\s*#include\>"
syntax region nddlString start=+"+ skip=+\\"+ end=+"+ oneline
syntax match nddlComment "//.*$" contains=@Spell
syntax region nddlComment start="/\*" end="\*/" contains=@Spell

highlight default link nddlWord Keyword
highlight default link nddlType Type
highlight default link nddlGoal Statement
highlight default link nddlRelation Operator
highlight default link nddlConstant Constant
highlight default link nddlNumber Number
highlight default link nddlInclude Include
highlight default link nddlString String
highlight default link nddlComment Comment

let b:current_syntax = "nddl"
