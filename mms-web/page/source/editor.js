// The editor of a field file: highlighting, completions, and messages at their place.
import { autocompletion, closeBrackets, closeBracketsKeymap, completionKeymap } from "@codemirror/autocomplete";
import { defaultKeymap, history, historyKeymap } from "@codemirror/commands";
import { HighlightStyle, StreamLanguage, bracketMatching, syntaxHighlighting } from "@codemirror/language";
import { lintGutter, lintKeymap, setDiagnostics } from "@codemirror/lint";
import { EditorState } from "@codemirror/state";
import { EditorView, drawSelection, highlightActiveLine, keymap, lineNumbers } from "@codemirror/view";
import { tags } from "@lezer/highlight";
import { completions } from "./complete.js";
import { toml } from "./toml.js";

const colours = HighlightStyle.define([
  { tag: tags.propertyName, color: "var(--code-key)" },
  { tag: tags.atom, color: "var(--code-table)", fontWeight: "600" },
  { tag: tags.string, color: "var(--code-string)" },
  { tag: tags.number, color: "var(--code-number)" },
  { tag: tags.comment, color: "var(--code-comment)", fontStyle: "italic" },
]);

/** Returns the offset of a line and a column, both from 1, columns in characters. */
function offset(doc, line, column) {
  const at = doc.line(Math.min(Math.max(line, 1), doc.lines));
  const before = [...at.text].slice(0, Math.max(column, 1) - 1).join("").length;
  return at.from + before;
}

/** Returns the range that a diagnostic marks; at least one character where there is one. */
function range(doc, diagnostic) {
  if (diagnostic.line == null) return { from: 0, to: 0 };
  const from = offset(doc, diagnostic.line, diagnostic.column ?? 1);
  const to = offset(doc, diagnostic.end_line ?? diagnostic.line, diagnostic.end_column ?? (diagnostic.column ?? 1) + 1);
  return { from, to: Math.min(Math.max(to, from + 1), doc.length) };
}

/** Returns the message and details of a diagnostic, in one text. */
export function wording(diagnostic) {
  const help = (diagnostic.help ?? []).map((line) => `help: ${line}`);
  return [diagnostic.message, diagnostic.label, ...help].filter(Boolean).join("\n");
}

/**
 * Makes an editor.
 * @param {{parent: HTMLElement, label: string, onChange: (text: string) => void, schema?: () => object|null}} options
 */
export function createEditor({ parent, label, onChange, schema }) {
  const source = (context) =>
    schema?.() ? completions(schema(), context.state.doc.toString(), context.pos, context.explicit) : null;
  const view = new EditorView({
    parent,
    state: EditorState.create({
      extensions: [
        lineNumbers(),
        history(),
        drawSelection(),
        highlightActiveLine(),
        bracketMatching(),
        closeBrackets(),
        StreamLanguage.define(toml),
        syntaxHighlighting(colours),
        autocompletion({ override: [source], icons: false }),
        lintGutter(),
        keymap.of([...closeBracketsKeymap, ...completionKeymap, ...lintKeymap, ...historyKeymap, ...defaultKeymap]),
        EditorView.contentAttributes.of({ "aria-label": label, spellcheck: "false", autocapitalize: "off" }),
        EditorView.updateListener.of((update) => update.docChanged && onChange(update.state.doc.toString())),
      ],
    }),
  });
  return {
    get text() {
      return view.state.doc.toString();
    },
    set text(text) {
      view.dispatch({ changes: { from: 0, to: view.state.doc.length, insert: text }, selection: { anchor: 0 }, scrollIntoView: true });
    },
    /** Shows diagnostics at their place, instead of the previous ones. */
    mark(diagnostics) {
      const marks = diagnostics
        .filter((diagnostic) => diagnostic.line != null)
        .map((diagnostic) => ({ ...range(view.state.doc, diagnostic), severity: diagnostic.severity ?? "error", message: wording(diagnostic) }));
      view.dispatch(setDiagnostics(view.state, marks));
    },
    /** Goes to the place of a diagnostic. */
    visit(diagnostic) {
      const { from, to } = range(view.state.doc, diagnostic);
      view.dispatch({ selection: { anchor: from, head: to }, effects: EditorView.scrollIntoView(from, { y: "center" }) });
      view.focus();
    },
  };
}
