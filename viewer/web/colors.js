// Colours of pictures: the names, lights and palettes of the program's own renderer.
const names = {
    white: '#ffffff', black: '#000000', gray: '#808080', lightgray: '#d9d9d9', darkgray: '#404040', clay: '#cccbc8',
    red: '#d63633', orange: '#ed872e', yellow: '#f0cc47', green: '#4da85c', teal: '#299e9e', blue: '#73a1e3',
    purple: '#9c63c9', sand: '#debd8f', region: '#73a1e3', handle: '#9c63c9', noValue: '#9e9e9e',
};
const categories = ['#e34d2e', '#21998c', '#f2a826', '#476bcc', '#cc4794', '#6ba638', '#7a59b3', '#996b47'];

// Red, green, blue from 0 to 255 of "#rrggbb", a name, or the number of a part from 1.
export function rgb(color) {
    if (typeof color === 'number') {
        const pale = 0.25 * (1 + Math.floor((color - 1) / 8) % 3);
        return rgb(categories[(color - 1) % 8]).map(x => Math.round(x + (255 - x) * pale));
    }
    const text = names[color] || color || names.clay;
    const hex = text.length === 4 ? text.slice(1).replace(/./g, '$&$&') : text.slice(1, 7);
    const value = parseInt(hex, 16);
    return Number.isNaN(value) ? rgb('clay') : [value >> 16 & 255, value >> 8 & 255, value & 255];
}

export const css = color => `rgb(${rgb(color).join(' ')})`;
export const toLinear = byte => (byte / 255 <= 0.04045 ? byte / 255 / 12.92 : Math.pow((byte / 255 + 0.055) / 1.055, 2.4));
// A scale of numbers, from dark blue over green to yellow.
const scale = [[68, 1, 84], [71, 45, 123], [59, 82, 139], [44, 114, 142], [33, 145, 140], [40, 174, 128],
    [94, 201, 98], [173, 220, 48], [253, 231, 37]];
// The colour of a fraction on the scale, by a spline of Catmull and Rom.
export function scaled(fraction) {
    const last = scale.length - 1, at = Math.min(Math.max(fraction, 0), 1) * last, i = Math.min(Math.floor(at), last - 1), t = at - i;
    const point = offset => scale[Math.min(Math.max(i + offset, 0), last)];
    return scale[i].map((x, k) => {
        const before = point(-1)[k], next = point(1)[k], here = 0.5 * (next - before), there = 0.5 * (point(2)[k] - x);
        return Math.round(Math.min(Math.max(x + t * (here + t * (3 * (next - x) - 2 * here - there + t * (2 * (x - next) + here + there))), 0), 255));
    });
}
// The scale as `count` texels.
export const colormap = count => new Uint8Array(Array.from({ length: count }, (_, i) => [...scaled(i / (count - 1)), 255]).flat());
export const scaleGradient = `linear-gradient(to top, ${scale.map(c => `rgb(${c.join(' ')})`).join(', ')})`;
