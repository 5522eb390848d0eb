// Marks of a tool over the picture, on a canvas of their own: as the window draws them, before all surfaces.
const ink = '#f2f2f2', dark = 'rgb(20 22 26 / 78%)';
const usual = { point: '#e8a33d', line: '#14161a', outline: ink, surface: '#e8a33d', label: ink };
const font = '12px system-ui, -apple-system, "Segoe UI", Roboto, "Noto Sans", sans-serif';

// Lists that Lua leaves without content are tables like any.
const listed = value => (Array.isArray(value) ? value : []);

// Pieces of a line of the world before the camera, as pixels.
function pieces(points, project, closed) {
    const numbers = closed && points.length > 3 ? [...points, ...points.slice(0, 3)] : points, found = [];
    let piece = null;
    for (let i = 0; i + 2 < numbers.length; i += 3) {
        const at = project(numbers[i], numbers[i + 1], numbers[i + 2]);
        if (!at) { piece = null; continue; }
        if (!piece) found.push(piece = []);
        piece.push(at);
    }
    return found;
}

function trace(context, pixels) {
    context.beginPath();
    pixels.forEach(([x, y], i) => (i ? context.lineTo(x, y) : context.moveTo(x, y)));
}

function drawSurface(context, { from, to, color, opacity = 0.25 }, project) {
    context.fillStyle = color || usual.surface;
    context.globalAlpha = opacity;
    const at = (list, i) => project(list[i], list[i + 1], list[i + 2]);
    for (let i = 0; i + 5 < Math.min(from.length, to.length); i += 3) {
        const corners = [at(from, i), at(from, i + 3), at(to, i + 3), at(to, i)];
        if (!corners.every(Boolean)) continue;
        trace(context, corners);
        context.fill();
    }
    context.globalAlpha = 1;
}

function drawLine(context, { points, color, width = 3, closed }, project) {
    context.strokeStyle = color || usual.line;
    context.lineWidth = width;
    for (const pixels of pieces(points, project, closed)) {
        trace(context, pixels);
        context.stroke();
    }
}

// A ball in the light from above on the left.
function drawBall(context, x, y, radius, color) {
    context.beginPath();
    context.arc(x, y, radius, 0, 2 * Math.PI);
    context.fillStyle = color;
    context.fill();
    const light = context.createRadialGradient(x - 0.4 * radius, y - 0.45 * radius, 0, x, y, 1.05 * radius);
    light.addColorStop(0, 'rgb(255 255 255 / 55%)');
    light.addColorStop(0.45, 'rgb(255 255 255 / 5%)');
    light.addColorStop(1, 'rgb(0 0 0 / 38%)');
    context.fillStyle = light;
    context.fill();
}

function drawPoints(context, { points, color, radius = 5 }, project) {
    for (let i = 0; i + 2 < points.length; i += 3) {
        const at = project(points[i], points[i + 1], points[i + 2]);
        if (at) drawBall(context, at[0], at[1], radius, color || usual.point);
    }
}

// A line of the picture: seen before light and dark.
function drawOutline(context, { pixels, color, width = 1.5, opacity = 1, closed }) {
    if (pixels.length < 4) return;
    context.beginPath();
    for (let i = 0; i + 1 < pixels.length; i += 2) context.lineTo(pixels[i], pixels[i + 1]);
    if (closed) context.closePath();
    context.globalAlpha = opacity;
    if (!color) { context.strokeStyle = dark; context.lineWidth = width + 2; context.stroke(); }
    context.strokeStyle = color || usual.outline;
    context.lineWidth = width;
    context.stroke();
    context.globalAlpha = 1;
}

function drawCircle(context, { at, radius = 20, color }) {
    context.beginPath();
    context.arc(at[0], at[1], radius, 0, 2 * Math.PI);
    context.strokeStyle = dark;
    context.lineWidth = 3;
    context.stroke();
    context.strokeStyle = color || usual.outline;
    context.lineWidth = 1.5;
    context.stroke();
}

function wrapped(context, text, most) {
    const lines = [];
    for (const whole of text.split('\n')) {
        let line = '';
        for (const word of whole.split(' ')) {
            if (line && context.measureText(`${line} ${word}`).width > most) { lines.push(line); line = word; } else line = line ? `${line} ${word}` : word;
        }
        lines.push(line);
    }
    return lines;
}

function drawLabel(context, { at, text, color }, project, size) {
    const place = at && text && project(...at);
    if (!place) return;
    const lines = wrapped(context, text, Math.min(320, size.width - size.left - 24)), wide = Math.max(...lines.map(line => context.measureText(line).width)) + 16, high = 17 * lines.length + 8;
    const x = Math.max(size.left + 4, Math.min(place[0] + 10, size.width - wide - 4)), y = Math.max(4, Math.min(place[1] - 10 - high, size.height - high - 4));
    context.beginPath();
    context.roundRect(x, y, wide, high, 6);
    context.fillStyle = dark;
    context.fill();
    context.fillStyle = color || usual.label;
    lines.forEach((line, i) => context.fillText(line, x + 8, y + 17 + 17 * i));
}

// `project` gives the pixel of a point of the world, or null behind the camera; `isAway`: no cursor is over the picture;
// `left` and `right`: pixels at the sides that something covers.
export function drawMarks(canvas, marks, { project, isAway, left, right }) {
    const scale = Math.min(window.devicePixelRatio || 1, 2), size = { width: canvas.clientWidth, height: canvas.clientHeight };
    const width = Math.max(Math.round(size.width * scale), 1), height = Math.max(Math.round(size.height * scale), 1);
    if (canvas.width !== width || canvas.height !== height) { canvas.width = width; canvas.height = height; }
    const context = canvas.getContext('2d');
    context.setTransform(scale, 0, 0, scale, 0, 0);
    context.clearRect(0, 0, size.width, size.height);
    if (!marks) return;
    Object.assign(context, { lineJoin: 'round', lineCap: 'round', font });
    listed(marks.surfaces).forEach(mark => drawSurface(context, mark, project));
    listed(marks.lines).forEach(mark => drawLine(context, mark, project));
    listed(marks.points).forEach(mark => drawPoints(context, mark, project));
    listed(marks.outlines).forEach(mark => drawOutline(context, mark));
    if (!isAway) listed(marks.circles).forEach(mark => drawCircle(context, mark));
    listed(marks.labels).forEach(mark => drawLabel(context, mark, project, { left, width: size.width - right, height: size.height }));
}
