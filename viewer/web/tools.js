// The tools of scripts/tools that the page has buttons for, and buttons for their keys: fingers have no keyboard.
const icon = path => `<svg viewBox="0 0 20 20" aria-hidden="true"><g fill="none" stroke="currentColor" stroke-width="1.6" stroke-linecap="round" stroke-linejoin="round">${path}</g></svg>`;
const head = '<path d="M6.2 17v-2.6C4.4 13.2 3.6 11.4 3.6 9.4a6.4 6.4 0 0 1 12.8 0c0 2-.8 3.8-2.6 5V17"/>';

const remove = ['delete', 'Delete', 'The chosen one'], next = ['tab', 'Next', 'Choose the next one'];

export const tools = [
    { name: '', title: 'Turn', help: 'No tool: drag turns the view', icon: icon('<circle cx="10" cy="10" r="3.2"/><path d="M17.2 10c0 2.2-3.2 4-7.2 4s-7.2-1.8-7.2-4 3.2-4 7.2-4c2 0 3.8.5 5.1 1.2M15.6 4.4l-.3 2.9-2.9-.2"/>') },
    { name: 'select', title: 'Select', icon: icon('<path d="M4 3.5l11.5 5.2-4.9 1.7-2 5z"/>'), shift: 'Add', ctrl: 'Remove',
        keys: [['a', 'All', 'Select all'], ['d', 'None', 'Select nothing'], ['i', 'Invert', 'Select the others'], ['+', 'Grow', 'By a ring'], ['-', 'Shrink', 'By a ring']] },
    { name: 'deform', title: 'Deform', icon: icon('<path d="M3 15.5c4.5 0 4-9 8-9"/><circle cx="3.4" cy="15.5" r="1.3"/><circle cx="12.7" cy="6.5" r="1.7"/><path d="M15.2 6.5h2.5M16.5 5.2l1.3 1.3-1.3 1.3"/>'), shift: 'Add',
        keys: [['enter', 'Handle', 'Make a handle of the selection'], ['p', 'Pin', 'The selection holds its place'], ['w', 'Move', ''], ['e', 'Turn', ''], ['r', 'Scale', ''], next, remove, ['f', 'Finish', 'The shape stays; handles go']] },
    { name: 'bones', title: 'Bones', icon: icon('<circle cx="4" cy="15.5" r="1.6"/><circle cx="9" cy="8.5" r="1.6"/><circle cx="16" cy="5" r="1.6"/><path d="M5 14.200l3-4.400M10.5 7.800l4-2"/>'),
        keys: [['enter', 'Lay', 'A chain through the clicked joints'], ['backspace', 'Back', 'Takes the last joint back'], next, ['r', 'Rest', 'The chain goes back to rest'], remove, ['f', 'Finish', 'The shape stays; bones go']] },
    { name: 'redraw', title: 'Redraw', icon: icon('<path d="M3 16c5 0 4-10 10-11"/><path d="M3.5 12.500c1.5-1 2-3 3-5" stroke-dasharray="1.5 2"/><path d="M13 8l3.5-3.5 1 1L14 9l-1.5.5z"/>'), keys: [] },
    { name: 'smooth', title: 'Smooth', icon: icon('<path d="M2.5 13c1.6-5 3-5 4.5 0s2.9 5 4.5 0c.9-3 2.6-4.5 6-4.5"/><path d="M13 4.5h4.5" stroke-dasharray="1.5 2"/>'), keys: [] },
    { name: 'cut', title: 'Cut', icon: icon('<circle cx="5" cy="5.5" r="2"/><circle cx="5" cy="14.5" r="2"/><path d="M6.8 6.600L16.5 14M6.8 13.400L16.5 6"/>'),
        keys: [['enter', 'Cut', 'Along the clicked points or the selection'], ['backspace', 'Back', 'Takes the last point back']] },
    { name: 'merge', title: 'Merge', icon: icon('<path d="M3.5 4v5.500a3 3 0 0 0 6 0V4M10.5 16v-5.500a3 3 0 0 1 6 0V16"/><path d="M8 13.500h4"/>'), ctrl: 'Turn',
        keys: [['enter', 'Take', 'The merged surface stays']] },
    { name: 'paste', title: 'Paste', icon: icon('<path d="M3 16.5c1.5-3.5 4-5 7-5s5.5 1.5 7 5"/><path d="M10 2.5v5M7.8 5.5L10 7.7l2.2-2.2" /><path d="M7.4 9.8h5.2"/>'), keys: [] },
    { name: 'line', title: 'Line', icon: icon('<path d="M3 15.500c4-1 3.5-7 7-8s4 2.5 7-2"/><circle cx="3" cy="15.5" r="1"/><circle cx="17" cy="5.5" r="1"/>'), shift: 'Go on',
        keys: [['backspace', 'Back', 'Takes the last line away']] },
    { name: 'transform', title: 'Place', icon: icon('<path d="M10 2.500v15M2.5 10h15M8 4.500l2-2 2 2M8 15.500l2 2 2-2M4.5 8l-2 2 2 2M15.5 8l2 2-2 2"/>'),
        keys: [['w', 'Move', ''], ['e', 'Turn', ''], ['r', 'Scale', ''], next, ['h', 'Put back', 'To its first place']] },
    { name: 'measure', title: 'Measure', icon: icon('<path d="M2.5 13L13 2.5 17.5 7 7 17.500zM5.5 10l1.6 1.600M8 7.500l2.4 2.400M10.5 5l1.6 1.6"/>'),
        keys: [['backspace', 'Back', 'Takes the last point back'], ['d', 'None', 'Forgets all points']] },
    { name: 'stream', title: 'Stream', icon: icon(`${head}<path d="M8.5 5.5c3.5-.5 5 1.5 4.6 5.5"/>`),
        keys: [next, remove, ['m', 'Mirror', 'Its mirror image'], ['v', 'View', 'Streams are drawn in this view from now on']] },
    { name: 'comb', title: 'Comb', icon: icon('<path d="M3.5 5.5h13v2.6h-13zM5 8.1v6.400M8.3 8.1v6.400M11.7 8.1v6.400M15 8.1v6.4"/>'), keys: [] },
    { name: 'parting', title: 'Parting', icon: icon(`${head}<path d="M10 3.2v6.3" stroke-dasharray="1.5 2"/>`),
        keys: [next, remove, ['backspace', 'Tilt off', 'Takes the strokes beside it away']] },
    { name: 'ponytail', title: 'Ponytail', icon: icon('<circle cx="8" cy="9" r="5.2"/><path d="M12.4 6c2.4-.8 4 .4 4.3 3 .3 2.6-.4 5.4-2 7.5"/><path d="M11.8 4.8l1.5 2.4"/>'),
        keys: [['g', 'Gather', 'Draws hair into the tie from all around'], next, remove, ['backspace', 'Reset', 'Takes the strokes round and along it away'], ['v', 'View', 'Tails are drawn in this view from now on']] },
    { name: 'mask', title: 'Mask', icon: icon(`${head}<path d="M7 6.500c2-1.5 4.5-1.3 6 .3" stroke-width="3.2"/>`), keys: [['delete', 'Clear', 'Takes away all that was painted of this kind']] },
    { name: 'groom', title: 'Layers', icon: icon('<path d="M10 3l7 3.5-7 3.5-7-3.500zM3 10l7 3.5 7-3.500M3 13.500L10 17l7-3.5"/>'),
        keys: [['+', 'Down', 'The operator works later'], ['-', 'Up', 'The operator works earlier'], ['delete', 'Delete', 'Takes the chosen operator out']] },
    { name: 'dynamics', title: 'Shake', icon: icon(`${head}<path d="M1.5 7v4M18.5 7v4"/>`), keys: [] },
];
