// The editor of scripts: Lua, with completion and help from the reference of the library.
import { EditorView, basicSetup } from 'codemirror';
import { EditorState, Compartment, StateEffect, StateField } from '@codemirror/state';
import { Decoration, hoverTooltip, keymap } from '@codemirror/view';
import { HighlightStyle, StreamLanguage, indentUnit, syntaxHighlighting } from '@codemirror/language';
import { indentWithTab } from '@codemirror/commands';
import { acceptCompletion, autocompletion } from '@codemirror/autocomplete';
import { setDiagnostics } from '@codemirror/lint';
import { lua } from '@codemirror/legacy-modes/mode/lua';
import { tags } from '@lezer/highlight';

const words = ('and break do else elseif end false for function goto if in local nil not or repeat return then true until while '
    + 'assert error ipairs pairs pcall print require select tonumber tostring type math string table').split(' ');

// Functions by the name behind the last dot or colon.
let reference = { functions: [], methods: [], byLast: new Map() };
export function useReference({ functions }) {
    const byLast = new Map();
    for (const one of functions) {
        const last = one.name.split('.').pop();
        if (!byLast.has(last)) byLast.set(last, []);
        byLast.get(last).push(one);
    }
    // Classes begin with a capital letter or are called by a colon.
    reference = { functions: functions.filter(one => !one.call.includes(':')), methods: functions.filter(one => one.call.includes(':')), byLast };
}

function element(tag, text, className) {
    const made = document.createElement(tag);
    made.textContent = text;
    if (className) made.className = className;
    return made;
}

function helpOf(one) {
    const box = element('div', '', 'help');
    box.append(element('code', one.call, 'call'), element('p', one.summary));
    const rows = [...one.arguments, ...one.options].slice(0, 14);
    if (rows.length) {
        const list = box.appendChild(element('dl', ''));
        for (const row of rows) {
            const name = list.appendChild(element('dt', row.name));
            if (row.type) name.append(element('span', ' ' + row.type.slice(0, 48)));
            list.append(element('dd', row.help));
        }
        const left = one.arguments.length + one.options.length - rows.length;
        if (left > 0) box.append(element('p', `and ${left} more options`));
    }
    return box;
}

function functionAt(state, pos) {
    const line = state.doc.lineAt(pos), text = line.text;
    for (const match of text.matchAll(/([A-Za-z_][\w]*(?:\s*[.:]\s*[A-Za-z_]\w*)*)/g)) {
        const from = line.from + match.index, to = from + match[0].length;
        if (pos < from || pos > to) continue;
        // The name up to the place that is pointed at.
        const end = match[0].slice(pos - from).search(/[.:]|$/);
        const name = match[0].slice(0, pos - from + end).replace(/\s/g, '');
        const parts = name.split(/[.:]/), last = parts.pop(), found = reference.byLast.get(last);
        if (!found || parts.length === 0) return null;
        const before = parts.slice(1).concat(last).join('.');
        const exact = found.find(one => one.name === before && !one.call.includes(':'));
        const methods = found.filter(one => one.call.includes(':'));
        const chosen = parts[0] === 'lissom' ? exact : methods.find(one => one.call.split(':')[0] === parts[parts.length - 1]) || methods[0];
        return chosen ? { from, to, chosen, others: methods.length } : null;
    }
    return null;
}

// The open table of options that the cursor is in: the function that is called with it.
function calledAround(text) {
    let depth = 0;
    for (let i = text.length - 1; i >= 0; --i) {
        const c = text[i];
        if (c === '}' || c === ')') ++depth;
        else if (c === '{' || c === '(') {
            if (depth-- > 0) continue;
            const match = /([\w.:]+)\s*\(?\s*(?:[^(){}]*,\s*)?$/.exec(text.slice(0, i)) || /([\w.:]+)\s*$/.exec(text.slice(0, i));
            if (c === '{' && match) return match[1];
            depth = 0;
        }
    }
    return null;
}

function optionsAt(text) {
    const name = calledAround(text.slice(-2000));
    if (!name) return [];
    const found = reference.byLast.get(name.split(/[.:]/).pop()) || [];
    return found.flatMap(one => one.options.map(option => ({ ...option, of: one })));
}

function complete(context) {
    const text = context.state.sliceDoc(0, context.pos);
    const chain = context.matchBefore(/[A-Za-z_][\w]*(?:[.:][A-Za-z_]\w*)*[.:]?\w*/);
    if (!chain && !context.explicit) return null;
    const typed = chain ? chain.text : '', cut = Math.max(typed.lastIndexOf('.'), typed.lastIndexOf(':'));
    const from = chain ? chain.from + cut + 1 : context.pos;
    const one = (source, label, boost = 0) => ({ label, type: 'function', detail: source.call.replace(/^[^({]*/, '').slice(0, 40), boost, info: () => helpOf(source) });
    let options;
    if (cut >= 0 && typed[cut] === ':') {
        const seen = new Map();
        for (const method of reference.methods) {
            const label = method.name.split('.').pop(), exact = method.call.split(':')[0] === typed.slice(0, cut).split(/[.:]/).pop();
            if (!seen.has(label) || exact) seen.set(label, one(method, label, exact ? 2 : 0));
        }
        options = [...seen.values()];
    } else if (cut >= 0) {
        const before = typed.slice(0, cut).replace(/^lissom\.?/, ''), start = before ? before + '.' : '';
        if (!typed.startsWith('lissom')) return null;
        options = reference.functions.filter(f => f.name.startsWith(start) && !f.name.slice(start.length).includes('.')).map(f => one(f, f.name.slice(start.length), 1));
        if (!start) options.push({ label: 'shapes', type: 'namespace', boost: 2 }, { label: 'part', type: 'namespace' });
    } else {
        options = optionsAt(text).map(option => ({ label: option.name, type: 'property', boost: 3, detail: option.type?.slice(0, 30), info: option.help, apply: option.name + ' = ' }));
        const names = new Set(text.match(/[A-Za-z_]\w+/g) || []);
        names.delete(typed);
        options.push({ label: 'lissom', type: 'namespace', boost: 1 });
        options.push(...words.map(label => ({ label, type: 'keyword' })), ...[...names].filter(n => !words.includes(n)).map(label => ({ label, type: 'variable' })));
    }
    return { from, options, validFor: /^\w*$/ };
}

const help = hoverTooltip((view, pos) => {
    const found = functionAt(view.state, pos);
    return found && { pos: found.from, end: found.to, above: true, create: () => ({ dom: helpOf(found.chosen) }) };
}, { hoverTime: 350 });

const markLine = StateEffect.define();
const markedLine = StateField.define({
    create: () => Decoration.none,
    update(marks, change) {
        marks = change.docChanged ? Decoration.none : marks;
        for (const effect of change.effects) {
            if (!effect.is(markLine)) continue;
            marks = effect.value === null ? Decoration.none
                : Decoration.set([Decoration.line({ class: 'failed-line' }).range(change.state.doc.line(effect.value).from)]);
        }
        return marks;
    },
    provide: field => EditorView.decorations.from(field),
});

const highlight = HighlightStyle.define([
    { tag: tags.keyword, color: 'var(--code-keyword)' },
    { tag: [tags.string, tags.special(tags.string)], color: 'var(--code-string)' },
    { tag: tags.number, color: 'var(--code-number)' },
    { tag: tags.comment, color: 'var(--code-comment)', fontStyle: 'italic' },
    { tag: [tags.bool, tags.null, tags.atom], color: 'var(--code-number)' },
    { tag: tags.standard(tags.variableName), color: 'var(--code-builtin)' },
]);

export class Editor {
    // `changed()` after each change by hand, `run()` on Ctrl-Enter.
    constructor(parent, { changed, run }) {
        this.quiet = false;
        this.theme = new Compartment();
        this.view = new EditorView({
            parent,
            state: EditorState.create({ doc: '', extensions: [
                keymap.of([{ key: 'Mod-Enter', run: () => { run(); return true; } }, { key: 'Mod-s', run: () => { run(); return true; } },
                    { key: 'Tab', run: acceptCompletion }, indentWithTab]),
                basicSetup, StreamLanguage.define(lua), syntaxHighlighting(highlight), indentUnit.of('    '),
                autocompletion({ override: [complete], maxRenderedOptions: 60 }), help, markedLine,
                EditorView.updateListener.of(update => { if (update.docChanged && !this.quiet) changed(); }),
                EditorView.contentAttributes.of({ 'aria-label': 'Script' }),
            ] }),
        });
    }
    get text() { return this.view.state.doc.toString(); }
    set text(text) {
        this.quiet = true;
        this.view.dispatch({ changes: { from: 0, to: this.view.state.doc.length, insert: text }, selection: { anchor: 0 }, scrollIntoView: true });
        this.quiet = false;
    }
    clear() {
        this.view.dispatch({ effects: markLine.of(null) });
        this.view.dispatch(setDiagnostics(this.view.state, []));
    }
    // Marks a line that failed.
    mark(number, message) {
        if (number < 1 || number > this.view.state.doc.lines) return;
        const line = this.view.state.doc.line(number);
        const start = line.from + line.text.search(/\S|$/);
        this.view.dispatch({ effects: markLine.of(number) });
        this.view.dispatch(setDiagnostics(this.view.state, [{ from: start, to: line.to, severity: 'error', message }]));
    }
    jump(number) {
        if (number < 1 || number > this.view.state.doc.lines) return;
        const line = this.view.state.doc.line(number);
        this.view.dispatch({ selection: { anchor: line.from }, effects: EditorView.scrollIntoView(line.from, { y: 'center' }) });
        this.view.focus();
    }
    insert(text) {
        const at = this.view.state.selection.main;
        this.view.dispatch({ changes: { from: at.from, to: at.to, insert: text } });
    }
}
