;;; A user of Emacs: opens a model, reads what is wrong, jumps, completes, mends, renames over two files, formats.
;; NDDLC_SCRIPT is a folder with model.nddl and part.nddl; what was seen goes into seen.json there.  -*- lexical-binding: t -*-

(require 'json)
(require 'nddl-mode)

(defvar seen nil)
(defvar folder (getenv "NDDLC_SCRIPT"))

(defun see (name value)
  "Note what the user sees."
  (push (cons name value) seen))

(defun await (what condition)
  "Wait for CONDITION; WHAT it is stands in the error."
  (let ((end (+ (float-time) 240)))
    (while (not (funcall condition))
      (when (> (float-time) end) (error "waited in vain for %s" what))
      (accept-process-output nil 0.05))))

(defun go-to (line column)
  "Stand at LINE, from 1, and COLUMN, from 0."
  (goto-char (point-min))
  (forward-line (1- line))
  (forward-char column))

(defun text () (buffer-substring-no-properties (point-min) (point-max)))

(defun wrong ()
  "The messages at the text."
  (mapcar #'flymake-diagnostic-text (flymake-diagnostics)))

(defun work ()
  "What the user does."
  (setq make-backup-files nil create-lockfiles nil eglot-sync-connect t eglot-connect-timeout 240
        eglot-confirm-server-initiated-edits nil eglot-send-changes-idle-time 0)
  (find-file (expand-file-name "model.nddl" folder))
  (see 'mode (symbol-name major-mode))
  (unless (eglot-managed-p) (apply #'eglot (eglot--guess-contact)))
  (await "the server" #'eglot-managed-p)
  (flymake-start)
  (await "diagnostics" #'wrong)
  (see 'wrong (vconcat (wrong)))

  (let ((model (current-buffer)))
    (go-to 3 12)
    (xref-find-definitions (substring-no-properties (thing-at-point 'symbol)))
    (see 'jumped (vector (file-name-nondirectory (buffer-file-name)) (line-number-at-pos) (current-column)))
    (switch-to-buffer model))

  (go-to 3 9)
  (let ((offered (eglot-completion-at-point)))
    (see 'offered (vconcat (mapcar #'substring-no-properties (all-completions "" (nth 2 offered))))))

  (go-to 4 18)
  (let ((action (elt (eglot-code-actions (point) (1+ (point)) nil nil) 0)))
    (see 'action (plist-get action :title))
    (eglot--apply-workspace-edit (plist-get action :edit)))
  (eglot--signal-textDocument/didChange)
  (flymake-start)
  (await "the mend" (lambda () (not (seq-some (lambda (each) (string-match-p "Gpz" each)) (wrong)))))
  (see 'mended (text))

  (go-to 3 12)
  (eglot-rename "Awake")
  (see 'renamed (text))
  (save-some-buffers t)

  (eglot-format-buffer)
  (see 'formatted (text))
  (save-some-buffers t)
  (eglot-shutdown (eglot-current-server)))

(condition-case problem
    (work)
  (error (see 'problem (format "%S" problem))))
(with-temp-file (expand-file-name "seen.json" folder)
  (insert (json-encode seen)))
(kill-emacs 0)
