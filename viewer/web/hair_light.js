// Light inside of hair: on a grid around it, how much of the light from all sides arrives, and from where.
// Of the tint of the scalp: widths a square metre of full hair, shares of the usual density, metres over which roots are
// even.
const fullWidths = 55, bareShare = 0.05, coveredShare = 1, rootMean = 0.0165;
const directions = [];
for (let x = -1; x <= 1; ++x)
    for (let y = -1; y <= 1; ++y)
        for (let z = -1; z <= 1; ++z) if (x || y || z) directions.push([x, y, z]);

function boundsOf(points) {
    const low = [Infinity, Infinity, Infinity], high = [-Infinity, -Infinity, -Infinity];
    for (let i = 0; i < points.length; ++i) {
        const k = i % 3;
        if (points[i] < low[k]) low[k] = points[i];
        if (points[i] > high[k]) high[k] = points[i];
    }
    return { low, high };
}

// Cells along the longest side, and a margin of two around.
function gridAround(points, cells) {
    const { low, high } = boundsOf(points);
    const step = Math.max(...high.map((x, k) => x - low[k]), 1e-6) / cells;
    return { step, origin: low.map(x => x - 2 * step), size: high.map((x, k) => Math.ceil((x - low[k]) / step) + 4) };
}

// Light is scattered on by strands more than they take away: the part of the area that they cover that counts as lost.
const lostShare = 0.4;
// Optical depth of a step through each cell.
function depths(grid, points, offsets, widths) {
    const { size, origin, step } = grid, depth = new Float32Array(size[0] * size[1] * size[2]);
    const area = step * step;
    for (let s = 0; s + 1 < offsets.length; ++s) {
        for (let p = offsets[s]; p + 1 < offsets[s + 1]; ++p) {
            const a = 3 * p, b = a + 3;
            const long = Math.hypot(points[b] - points[a], points[b + 1] - points[a + 1], points[b + 2] - points[a + 2]);
            const at = [0, 1, 2].map(k => Math.floor((0.5 * (points[a + k] + points[b + k]) - origin[k]) / step));
            depth[at[0] + size[0] * (at[1] + size[1] * at[2])] += lostShare * long * widths[p] / area;
        }
    }
    return depth.map(d => 1.4 * (1 - Math.exp(-d / 1.4)));
}

// Points below a surface let nothing through. `head` are corners of triangles in the points' unit.
function addHead(grid, depth, head) {
    const { size, origin, step } = grid, fill = 6;
    for (let t = 0; t + 8 < head.length; t += 9) {
        const a = [0, 1, 2].map(k => head[t + 3 + k] - head[t + k]), b = [0, 1, 2].map(k => head[t + 6 + k] - head[t + k]);
        const n = [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
        const l = Math.hypot(...n) || 1;
        for (const below of [2, 3]) {
            const at = [0, 1, 2].map(k => Math.floor(((head[t + k] + head[t + 3 + k] + head[t + 6 + k]) / 3
                - below * step * n[k] / l - origin[k]) / step));
            if (at.every((x, k) => x >= 0 && x < size[k])) depth[at[0] + size[0] * (at[1] + size[1] * at[2])] = fill;
        }
    }
}

function arrives(grid, depth, x, y, z, d) {
    const { size } = grid, long = Math.hypot(d[0], d[1], d[2]);
    let sum = 0.5 * depth[x + size[0] * (y + size[1] * z)];
    for (;;) {
        x += d[0]; y += d[1]; z += d[2];
        if (x < 0 || y < 0 || z < 0 || x >= size[0] || y >= size[1] || z >= size[2]) return Math.exp(-sum * long);
        sum += depth[x + size[0] * (y + size[1] * z)];
        if (sum > 12) return 0;
    }
}

// A texel a cell: the mean of light from all sides and its slope along the axes.
function momentsOf(grid, depth) {
    const { size } = grid, texels = new Uint8Array(4 * depth.length);
    let at = 0;
    for (let z = 0; z < size[2]; ++z)
        for (let y = 0; y < size[1]; ++y)
            for (let x = 0; x < size[0]; ++x) {
                let mean = 0, slope = [0, 0, 0];
                for (const d of directions) {
                    const light = arrives(grid, depth, x, y, z, d) / directions.length;
                    const long = Math.hypot(d[0], d[1], d[2]);
                    mean += light;
                    for (let k = 0; k < 3; ++k) slope[k] += 2.4 * light * d[k] / long;
                }
                texels[at++] = 255 * mean;
                for (let k = 0; k < 3; ++k) texels[at++] = 127.5 + 127.5 * Math.min(Math.max(slope[k], -1), 1);
            }
    return texels;
}

// Adds a value to the eight cells around a place, by how near they are.
function splat(grid, values, place, value) {
    const { size, origin, step } = grid, at = place.map((x, k) => (x - origin[k]) / step - 0.5), cell = at.map(Math.floor);
    for (let i = 0; i < 8; ++i) {
        const to = cell.map((x, k) => x + (i >> k & 1));
        const share = at.reduce((all, x, k) => all * (i >> k & 1 ? x - cell[k] : 1 - x + cell[k]), 1);
        if (to.every((x, k) => x >= 0 && x < size[k])) values[to[0] + size[0] * (to[1] + size[1] * to[2])] += share * value;
    }
}

// Means over three cells along each axis.
function smoothed({ size }, values) {
    const steps = [1, size[0], size[0] * size[1]];
    for (let k = 0; k < 3; ++k) {
        const from = values.slice(), step = steps[k];
        for (let i = 0; i < values.length; ++i) {
            const at = Math.floor(i / step) % size[k];
            values[i] = (from[i] + (at > 0 ? from[i - step] : 0) + (at + 1 < size[k] ? from[i + step] : 0)) / 3;
        }
    }
    return values;
}

function usualOf(values) {
    let sum = 0, squares = 0;
    for (const x of values) { sum += x; squares += x * x; }
    return sum > 0 ? squares / sum : 0;
}

// How far the scalp has the colour of the hair that grows there, a byte a cell: as scalp_tint in viewer/render/strands.
// `scale`: units of the points in a metre.
function scalpTint(grid, points, offsets, widths, scale) {
    const roots = new Float32Array(grid.size[0] * grid.size[1] * grid.size[2]), metres = grid.step / scale;
    for (let s = 0; s + 1 < offsets.length; ++s) {
        const p = offsets[s];
        if (offsets[s + 1] > p + 1) splat(grid, roots, [points[3 * p], points[3 * p + 1], points[3 * p + 2]], widths[p] / scale);
    }
    const strength = Math.min(usualOf(roots) / (fullWidths * metres * metres), 1);
    for (let pass = 0; pass < 3 && rootMean >= 2 * metres; ++pass) smoothed(grid, roots);
    const usual = usualOf(roots);
    return Uint8Array.from(roots, r => {
        const t = usual > 0 ? Math.min(Math.max((r / usual - bareShare) / (coveredShare - bareShare), 0), 1) : 0;
        return 255 * 0.7 * strength * t * t * (3 - 2 * t);
    });
}

// Returns the grid, the light that arrives at the hair, and the light behind hair alone: the shadow of the head on itself
// is no shadow of hair, and has none of its colour. `scale`: units of the points in a metre.
export function hairLight(points, offsets, widths, head, scale) {
    if (points.length < 6) return null;
    const grid = gridAround(points, 40), depth = depths(grid, points, offsets, widths);
    const onHead = momentsOf(grid, depth);
    if (!head) return { ...grid, texels: onHead, onHead, tint: new Uint8Array(depth.length) };
    addHead(grid, depth, head);
    return { ...grid, texels: momentsOf(grid, depth), onHead, tint: scalpTint(grid, points, offsets, widths, scale) };
}
