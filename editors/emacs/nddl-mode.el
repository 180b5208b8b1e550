;;; nddl-mode.el --- NDDL models by nddlc  -*- lexical-binding: t -*-

;; Emacs 29 or newer, with the built-in Eglot, or 28 with Eglot 1.9.

;;; Code:

(require 'cc-mode)
(require 'eglot)

(defvar nddl-command '("nddlc" "lsp")
  "The program that serves NDDL, with its arguments.")

(defconst nddl--words
  '("action" "class" "close" "condition" "effect" "else" "enforce" "enum" "extends" "filter" "foreach" "if" "in" "new"
    "predicate" "super" "this" "typedef" "goal" "fact" "rejectable"))

(defconst nddl--relations
  '("any" "before" "after" "meets" "met_by" "starts" "ends" "equals" "equal" "contains" "contained_by" "parallels"
    "paralleled_by" "starts_before" "starts_after" "starts_before_end" "starts_during" "ends_before" "ends_after"
    "ends_after_start" "ends_during" "contains_start" "contains_end"))

(defvar nddl-font-lock-keywords
  `((,(regexp-opt nddl--words 'symbols) . font-lock-keyword-face)
    (,(regexp-opt nddl--relations 'symbols) . font-lock-builtin-face)
    (,(regexp-opt '("int" "float" "bool" "string") 'symbols) . font-lock-type-face)
    (,(regexp-opt '("true" "false" "inf" "inff") 'symbols) . font-lock-constant-face)
    ("^[ \t]*#include\\_>" . font-lock-preprocessor-face)))

;;;###autoload
(define-derived-mode nddl-mode prog-mode "NDDL"
  "Major mode for models of EUROPA and T-REX."
  :syntax-table c++-mode-syntax-table
  (setq-local comment-start "// " comment-end "" indent-tabs-mode nil tab-width 2)
  (setq-local font-lock-defaults '(nddl-font-lock-keywords)))

;;;###autoload
(add-to-list 'auto-mode-alist '("\\.nddl\\'" . nddl-mode))
(add-to-list 'eglot-server-programs `(nddl-mode . ,nddl-command))
(add-hook 'nddl-mode-hook #'eglot-ensure)

(provide 'nddl-mode)
;;; nddl-mode.el ends here
