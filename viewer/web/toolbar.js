// Buttons of the tools, of their keys, and of undo and redo.
import { tools } from './tools.js';

const button = (set, content) => {
    const made = Object.assign(document.createElement('button'), { type: 'button', ...set });
    if (content) made.innerHTML = content;
    return made;
};

const arrows = { undo: 'M7.5 4L4 7.5 7.5 11M4.5 7.5h7a4.2 4.2 0 0 1 0 8.4H8', redo: 'M12.5 4L16 7.5 12.5 11M15.5 7.5h-7a4.2 4.2 0 0 0 0 8.4H12' };
const titles = { undo: ['Undo', 'Z'], redo: ['Redo', 'Y'] };

function arrow(kind, travel) {
    const picture = `<svg viewBox="0 0 20 20" aria-hidden="true"><path d="${arrows[kind]}" fill="none" stroke="currentColor" stroke-width="1.6" stroke-linecap="round" stroke-linejoin="round"/></svg>`;
    return button({ id: kind, disabled: true, ariaLabel: titles[kind][0], onclick: () => travel(kind) }, picture);
}

// Fills the bar; `take(name)` is called for a tool, `travel(kind)` for 'undo' and 'redo'.
export function fillToolbar(bar, { take, travel }) {
    const choices = tools.map(tool => {
        const made = button({ title: tool.help || tool.title, onclick: () => take(tool.name) }, `${tool.icon}<span>${tool.title}</span>`);
        made.dataset.tool = tool.name;
        return made;
    });
    bar.replaceChildren(...choices, document.createElement('i'), arrow('undo', travel), arrow('redo', travel));
    showTaken(bar, '');
}

export function showTaken(bar, name) {
    for (const one of bar.querySelectorAll('[data-tool]')) one.setAttribute('aria-pressed', String(one.dataset.tool === name));
}

// `steps`: the names of the steps that could be undone and redone, as hand.lua returns them.
export function showSteps(bar, steps) {
    for (const kind of ['undo', 'redo']) {
        const one = bar.querySelector(`#${kind}`), [title, letter] = titles[kind];
        if (!one) return;
        one.disabled = !steps?.[kind];
        one.title = `${title}${steps?.[kind] ? `: ${steps[kind]}` : ''} (Ctrl-${letter})`;
    }
}

// Shift and Ctrl for fingers: one of them stays down until it is pressed again, or the other.
function holder(box, hand, key, title) {
    const held = key === 'shift' ? 'Shift' : 'Ctrl';
    return button({ className: 'toggle', textContent: title, ariaPressed: 'false', title: `As with ${held} held down`, onclick: event => {
        hand.sticky = { shift: false, ctrl: false, [key]: !hand.sticky[key] };
        for (const one of box.querySelectorAll('.toggle')) one.setAttribute('aria-pressed', String(one === event.currentTarget && hand.sticky[key]));
    } });
}

// The keys of a tool as buttons, in `box`.
export function showKeys(box, hand, name) {
    const tool = tools.find(one => one.name === name);
    const holders = ['shift', 'ctrl'].filter(key => tool[key]).map(key => holder(box, hand, key, tool[key]));
    const keys = (tool.keys || []).map(([key, label, help]) => button({ textContent: label, title: `${help ? `${help} ` : ''}(${key})`, onclick: () => hand.key(key) }));
    box.replaceChildren(...holders, ...keys);
}
