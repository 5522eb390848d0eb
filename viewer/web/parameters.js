// The values of a script as sliders and fields, from the JSON of lissom_script_parameters.
const element = (tag, set = {}, ...children) => {
    const made = Object.assign(document.createElement(tag), set);
    made.append(...children);
    return made;
};
// Values that a page has no use for: folders of files, and models that other programs pick.
const aside = new Set(['file', 'folder']);

function digits(step) {
    return step >= 1 ? 0 : Math.min(4, Math.ceil(-Math.log10(step)));
}

function stepOf(one) {
    if (one.step) return one.step;
    if (one.type === 'integer') return 1;
    const wide = one.max - one.min;
    return Number.isFinite(wide) && wide > 0 ? Math.pow(10, Math.floor(Math.log10(wide / 100))) : 'any';
}

function slider(one, value, set) {
    const step = stepOf(one), places = digits(step);
    const number = element('input', { className: 'number', type: 'number', min: one.min, max: one.max, step: 'any', value });
    const range = element('input', { type: 'range', min: one.min, max: one.max, step, value, ariaLabel: one.name });
    range.oninput = () => { number.value = (+range.value).toFixed(places); set(+number.value); };
    number.onchange = () => { range.value = number.value; set(+number.value); };
    return [number, range];
}

function field(one, value, set) {
    if (one.type === 'boolean') {
        const box = element('input', { type: 'checkbox', checked: value === true || value === 'true' });
        box.onchange = () => set(box.checked);
        return [box];
    }
    if (one.type === 'choice') {
        const list = element('select', {}, ...one.choices.map(text => element('option', { value: text, textContent: text, selected: text === value })));
        list.onchange = () => set(list.value);
        return [list];
    }
    const isNumber = one.type === 'number' || one.type === 'integer';
    // A slider over thousands of vertices is of use, one over a million is not.
    if (isNumber && Number.isFinite(one.min) && Number.isFinite(one.max) && one.max - one.min <= 20000) return slider(one, value, set);
    const input = element('input', { type: isNumber ? 'number' : 'text', className: isNumber ? 'number' : '', value });
    if (isNumber) { input.step = 'any'; if (Number.isFinite(one.min)) input.min = one.min; }
    input.onchange = () => set(isNumber ? +input.value : input.value);
    return [input];
}

// Fills `form`; `changed(name, value)` is called as a hand moves. Returns whether there is anything to set.
export function showParameters(form, parameters, values, changed) {
    const rows = parameters.map(one => {
        const value = values[one.name] ?? one.value ?? one.default;
        const title = one.name.replaceAll('_', ' ') + (one.unit && one.unit !== 'none' ? `, ${one.unit}` : '');
        return { aside: aside.has(one.type), group: one.group || '', row: element('label', { className: 'one', title: one.help || '' },
            element('span', { textContent: title }), ...field(one, value, set => changed(one.name, set))) };
    });
    const first = rows.filter(one => !one.aside), others = rows.filter(one => one.aside);
    const title = (one, i) => (one.group && one.group !== first[i - 1]?.group ? [element('h3', { textContent: one.group })] : []);
    form.replaceChildren(...first.flatMap((one, i) => [...title(one, i), one.row]));
    if (others.length) form.append(element('details', {}, element('summary', { textContent: 'Files' }), ...others.map(one => one.row)));
    return parameters.length > 0;
}
