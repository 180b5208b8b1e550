(class body: (block) @class.inside) @class.around
(rule body: (block) @function.inside) @function.around
(predicate body: (block) @function.inside) @function.around
(constructor body: (block) @function.inside) @function.around
(parameter) @parameter.inside
(comment) @comment.inside
