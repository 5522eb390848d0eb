// Draws pictures of a script with WebGL 2: meshes, hair and lines, turned by mouse, pen and fingers.
import { cross, dot, length, lookAt, minus, perspective, plus, scaling, times, unit } from './matrix.js';
import { colormap, css, rgb } from './colors.js';
import { Occlusion } from './occlusion.js';
import { ballFragment, ballVertex, hairFragment, hairVertex, lineFragment, lineVertex, meshFragment, meshVertex } from './shaders.js';

const sides = {
    front: [0, 0, 1], back: [0, 0, -1], left: [-1, 0, 0.0001], right: [1, 0, 0.0001], top: [0, 1, 0.0001], bottom: [0, -1, 0.0001],
    'three-quarter': [0.538986, 0.342020, 0.769751],  // 35 degrees to the right, 20 up, as in kernel/sketch/camera.cpp
};
const identity = scaling(1);

function compiled(gl, vertex, fragment) {
    const program = gl.createProgram();
    for (const [type, text] of [[gl.VERTEX_SHADER, vertex], [gl.FRAGMENT_SHADER, fragment]]) {
        const shader = gl.createShader(type);
        gl.shaderSource(shader, text);
        gl.compileShader(shader);
        gl.attachShader(program, shader);
        if (!gl.getShaderParameter(shader, gl.COMPILE_STATUS) && !gl.isContextLost()) throw new Error(gl.getShaderInfoLog(shader));
    }
    // The same slots in all programs that draw meshes.
    ['a_position', 'a_normal'].forEach((name, slot) => gl.bindAttribLocation(program, slot, name));
    gl.linkProgram(program);
    if (!gl.getProgramParameter(program, gl.LINK_STATUS) && !gl.isContextLost()) throw new Error(gl.getProgramInfoLog(program));
    const places = {};
    const count = gl.getProgramParameter(program, gl.ACTIVE_UNIFORMS);
    for (let i = 0; i < count; ++i) {
        const { name } = gl.getActiveUniform(program, i);
        places[name] = gl.getUniformLocation(program, name);
    }
    const slots = {};
    const inputs = gl.getProgramParameter(program, gl.ACTIVE_ATTRIBUTES);
    for (let i = 0; i < inputs; ++i) {
        const { name } = gl.getActiveAttrib(program, i);
        slots[name] = gl.getAttribLocation(program, name);
    }
    return { program, places, slots };
}

// Each row of numbers two times.
function twice(values, width) {
    const doubled = new values.constructor(2 * values.length);
    for (let from = 0, to = 0; from < values.length; from += width) {
        for (let copy = 0; copy < 2; ++copy) for (let k = 0; k < width; ++k) doubled[to++] = values[from + k];
    }
    return doubled;
}

// Two triangles a segment, and their corners up to each of the starts, which are counts of points. Not an instance a
// segment: drivers that draw in software take far longer for each instance than for its triangles.
function ribbons(points, starts) {
    const count = points.length / 4 - 3, indices = new Uint32Array(6 * Math.max(count, 0)), ends = [];
    let at = 0;
    for (let p = 0; p <= count; ++p) {
        while (ends.length < starts.length && starts[ends.length] <= p) ends.push(at);
        if (p + 1 >= count || !(points[4 * (p + 1) + 3] >= 0)) continue;
        const v = 2 * p;
        indices.set([v, v + 1, v + 2, v + 2, v + 1, v + 3], at);
        at += 6;
    }
    return { indices: indices.subarray(0, at), ends };
}

// Count, sum and sum of squares of some of the places of a mesh.
function momentsOf({ positions, place }) {
    const stride = 3 * Math.ceil(positions.length / 60000 || 1), sum = [0, 0, 0];
    let count = 0, square = 0;
    for (let i = 0; i < positions.length; i += stride, ++count) {
        for (let k = 0; k < 3; ++k) {
            const x = place ? place[k] * positions[i] + place[4 + k] * positions[i + 1] + place[8 + k] * positions[i + 2] + place[12 + k] : positions[i + k];
            sum[k] += x;
            square += x * x;
        }
    }
    return { count, sum, square };
}

function joinedBoxes(a, b) {
    if (!a || !b) return a || b;
    return { low: a.low.map((x, k) => Math.min(x, b.low[k])), high: a.high.map((x, k) => Math.max(x, b.high[k])) };
}

export class View {
    // Calls `changed` after a frame. Throws if the browser has no WebGL 2.
    constructor(canvas, changed = () => {}) {
        this.canvas = canvas;
        this.changed = changed;
        this.gl = canvas.getContext('webgl2', { antialias: true, alpha: true, powerPreference: 'high-performance' });
        if (!this.gl) throw new Error('this browser has no WebGL 2');
        this.settings = { wire: false, flat: false, colors: true };
        this.isQuick = false;
        // Pixels at the sides under other things; a fitted view leaves them free.
        this.covered = () => ({ left: 0, right: 0, bottom: 0 });
        // Pointers that turn the view; a hand (hand.js) may take some of them for its tool.
        this.fingers = new Map();
        this.hand = null;
        this.drawn = { meshes: [], strands: [], lines: null };
        this.resetCamera({});
        this.open();
        this.listen();
        canvas.addEventListener('webglcontextlost', event => event.preventDefault());
        canvas.addEventListener('webglcontextrestored', () => { this.open(); if (this.picture) this.upload(this.picture); this.ask(); });
        new ResizeObserver(() => this.fitAgain()).observe(canvas);
    }

    open() {
        const gl = this.gl;
        this.mesh = compiled(gl, meshVertex, meshFragment);
        this.hair = compiled(gl, hairVertex, hairFragment);
        this.line = compiled(gl, lineVertex, lineFragment);
        this.ball = compiled(gl, ballVertex, ballFragment);
        this.occlusion = new Occlusion(gl, compiled);
        this.colormap = this.texture2d(256, colormap(256));
        gl.enable(gl.DEPTH_TEST);
        gl.depthFunc(gl.LEQUAL);
        this.noTint = this.texture3d([1, 1, 1], new Uint8Array([0]), gl.R8, gl.RED);
        this.noLight = this.texture3d([1, 1, 1], new Uint8Array([255, 128, 128, 128]));
    }

    // ---- Drawing

    // A picture of worker.js. The camera stays, unless `frame`.
    show(picture, frame) {
        this.picture = picture;
        this.upload(picture);
        if (frame) this.frame();
        this.ask();
    }

    // The picture after a tool: parts that are the `same` stay as they are drawn, and the camera as it is.
    update(picture) {
        const old = this.picture || { meshes: [], strands: [] }, known = this.drawn;
        const isSame = list => picture[list].length === old[list].length && picture[list].every(one => one.same);
        if (!old.columns && isSame('meshes') && isSame('strands') && !picture.lines.length && !known.lines) return old;
        const kept = (list, upload) => {
            const before = new Map((old[list] || []).map((one, i) => [one.object, { one, drawn: known[list][i] }]));
            const now = picture[list].map(one => {
                const found = before.get(one.object);
                if (one.same) return found;
                // Without flags the faces are the same.
                if (list === 'strands' || one.flags) return { one, drawn: upload(one) };
                this.refresh(found.drawn, one);
                return { one: { ...found.one, ...one }, drawn: found.drawn };
            });
            const stay = new Set(now.map(one => one.drawn));
            this.free(known[list].filter(one => !stay.has(one)));
            return now;
        };
        const meshes = kept('meshes', mesh => this.uploadMesh(mesh)), strands = kept('strands', one => this.uploadStrands(one));
        this.free([known.lines, known.balls]);
        this.drawn = { meshes: meshes.map(one => one.drawn), strands: strands.map(one => one.drawn), lines: this.uploadLines(picture) };
        picture.meshes = meshes.map(({ one }, i) => ({ ...one, raised: picture.meshes[i].raised }));
        picture.strands = strands.map(({ one }) => one);
        picture.box = [...picture.meshes, ...picture.strands].map(one => one.box).reduce(joinedBoxes, null);
        this.picture = { ...picture, up: old.up, view: old.view, camera: old.camera };
        if (old.columns) this.frame();
        this.ask();
        return this.picture;
    }

    upload(picture) {
        this.free();
        this.drawn.meshes = picture.meshes.map(mesh => this.uploadMesh(mesh));
        this.drawn.strands = picture.strands.map(strands => this.uploadStrands(strands));
        this.drawn.lines = this.uploadLines(picture);
        this.drawn.balls = this.uploadBalls(picture.balls);
    }

    free(list = null) {
        const gl = this.gl, { meshes, strands, lines, balls } = this.drawn, all = list || [...meshes, ...strands, lines, balls];
        for (const one of [...all, ...all.map(each => each?.balls)].filter(Boolean)) {
            gl.deleteVertexArray(one.array);
            one.buffers.forEach(buffer => gl.deleteBuffer(buffer));
            if (one.light) [one.light.texture, one.light.onHead, one.light.tinted].forEach(texture => gl.deleteTexture(texture));
        }
        if (!list) this.drawn = { meshes: [], strands: [], lines: null, balls: null };
    }

    buffer(values) {
        const gl = this.gl, buffer = gl.createBuffer();
        gl.bindBuffer(gl.ARRAY_BUFFER, buffer);
        gl.bufferData(gl.ARRAY_BUFFER, values, gl.STATIC_DRAW);
        return buffer;
    }

    attribute(slot, buffer, size, type, normal, stride, offset, divisor = 0) {
        const gl = this.gl;
        if (slot === undefined) return;
        gl.bindBuffer(gl.ARRAY_BUFFER, buffer);
        gl.enableVertexAttribArray(slot);
        gl.vertexAttribPointer(slot, size, type, normal, stride, offset);
        gl.vertexAttribDivisor(slot, divisor);
    }

    uploadMesh(mesh) {
        const gl = this.gl, { slots } = this.mesh, array = gl.createVertexArray();
        gl.bindVertexArray(array);
        const buffers = [mesh.positions, mesh.normals, mesh.colors, mesh.flags].map(values => this.buffer(values));
        this.attribute(slots.a_position, buffers[0], 3, gl.FLOAT, false, 0, 0);
        this.attribute(slots.a_normal, buffers[1], 3, gl.FLOAT, false, 0, 0);
        this.attribute(slots.a_color, buffers[2], 4, gl.UNSIGNED_BYTE, true, 0, 0);
        this.attribute(slots.a_flags, buffers[3], 1, gl.UNSIGNED_BYTE, false, 0, 0);
        gl.bindVertexArray(null);
        return { array, buffers, count: mesh.positions.length / 3, place: mesh.place || identity, raised: mesh.raised, balls: this.uploadBalls(mesh.balls), moments: momentsOf(mesh) };
    }

    // Other places or colours of a mesh that is drawn.
    refresh(drawn, mesh) {
        const gl = this.gl;
        [mesh.positions, mesh.normals, mesh.colors].forEach((values, i) => {
            if (!values) return;
            gl.bindBuffer(gl.ARRAY_BUFFER, drawn.buffers[i]);
            gl.bufferData(gl.ARRAY_BUFFER, values, gl.DYNAMIC_DRAW);
        });
        drawn.place = mesh.place || identity;
        if (mesh.positions) drawn.moments = momentsOf(mesh);
    }

    // Two vertices a point, which know the points before and after theirs.
    uploadStrands(strands) {
        const gl = this.gl, { slots } = this.hair, array = gl.createVertexArray();
        gl.bindVertexArray(array);
        const { indices, ends } = ribbons(strands.points, strands.starts);
        const buffers = [this.buffer(twice(strands.points, 4)), this.buffer(twice(new Uint32Array(strands.colors.buffer), 1))];
        for (const [name, point] of [['a_before', 0], ['a_here', 1], ['a_after', 2]]) {
            this.attribute(slots[name], buffers[0], 4, gl.FLOAT, false, 16, 32 * point);
        }
        this.attribute(slots.a_color, buffers[1], 4, gl.UNSIGNED_BYTE, true, 4, 8);
        const corners = gl.createBuffer();
        gl.bindBuffer(gl.ELEMENT_ARRAY_BUFFER, corners);
        gl.bufferData(gl.ELEMENT_ARRAY_BUFFER, indices, gl.STATIC_DRAW);
        gl.bindVertexArray(null);
        const light = strands.light && { ...strands.light, texture: this.texture3d(strands.light.size, strands.light.texels),
            onHead: this.texture3d(strands.light.size, strands.light.onHead), tinted: this.texture3d(strands.light.size, strands.light.tint, gl.R8, gl.RED) };
        return { array, buffers: [...buffers, corners], ends, light, look: strands.look };
    }

    // Null without any.
    uploadBalls(balls) {
        const gl = this.gl, { slots } = this.ball;
        if (!balls?.length) return null;
        const array = gl.createVertexArray();
        gl.bindVertexArray(array);
        const buffers = [this.buffer(new Float32Array(balls.flatMap(one => one.place))), this.buffer(new Uint8Array(balls.flatMap(one => [...rgb(one.color), 255])))];
        this.attribute(slots.a_place, buffers[0], 3, gl.FLOAT, false, 0, 0, 1);
        this.attribute(slots.a_color, buffers[1], 4, gl.UNSIGNED_BYTE, true, 0, 0, 1);
        gl.bindVertexArray(null);
        return { array, buffers, count: balls.length };
    }

    uploadLines(picture) {
        const gl = this.gl, from = [], to = [], colors = [];
        for (const line of picture.lines || []) {
            const color = [...rgb(line.color), 255];
            for (let i = 0; i + 5 < line.points.length; i += 3) {
                from.push(...line.points.slice(i, i + 3));
                to.push(...line.points.slice(i + 3, i + 6));
                colors.push(...color);
            }
        }
        if (from.length === 0) return null;
        const { slots } = this.line, array = gl.createVertexArray();
        gl.bindVertexArray(array);
        const buffers = [this.buffer(new Float32Array(from)), this.buffer(new Float32Array(to)), this.buffer(new Uint8Array(colors))];
        this.attribute(slots.a_from, buffers[0], 3, gl.FLOAT, false, 0, 0, 1);
        this.attribute(slots.a_to, buffers[1], 3, gl.FLOAT, false, 0, 0, 1);
        this.attribute(slots.a_color, buffers[2], 4, gl.UNSIGNED_BYTE, true, 0, 0, 1);
        gl.bindVertexArray(null);
        return { array, buffers, count: from.length / 3 };
    }

    // A row of colours.
    texture2d(width, texels) {
        const gl = this.gl, texture = gl.createTexture();
        gl.bindTexture(gl.TEXTURE_2D, texture);
        gl.texImage2D(gl.TEXTURE_2D, 0, gl.RGBA8, width, 1, 0, gl.RGBA, gl.UNSIGNED_BYTE, texels);
        for (const axis of [gl.TEXTURE_WRAP_S, gl.TEXTURE_WRAP_T]) gl.texParameteri(gl.TEXTURE_2D, axis, gl.CLAMP_TO_EDGE);
        for (const filter of [gl.TEXTURE_MIN_FILTER, gl.TEXTURE_MAG_FILTER]) gl.texParameteri(gl.TEXTURE_2D, filter, gl.LINEAR);
        return texture;
    }

    texture3d(size, texels, format = this.gl.RGBA8, kind = this.gl.RGBA) {
        const gl = this.gl, texture = gl.createTexture();
        gl.pixelStorei(gl.UNPACK_ALIGNMENT, 1);
        gl.bindTexture(gl.TEXTURE_3D, texture);
        gl.texImage3D(gl.TEXTURE_3D, 0, format, ...size, 0, kind, gl.UNSIGNED_BYTE, texels);
        for (const axis of [gl.TEXTURE_WRAP_S, gl.TEXTURE_WRAP_T, gl.TEXTURE_WRAP_R]) gl.texParameteri(gl.TEXTURE_3D, axis, gl.CLAMP_TO_EDGE);
        for (const filter of [gl.TEXTURE_MIN_FILTER, gl.TEXTURE_MAG_FILTER]) gl.texParameteri(gl.TEXTURE_3D, filter, gl.LINEAR);
        return texture;
    }

    // ---- The camera

    resetCamera({ view, up, camera }) {
        this.up = up === 'z' ? [0, 0, 1] : [0, 1, 0];
        this.fov = (camera?.fov || 30) * Math.PI / 180;
        const side = sides[view] || sides['three-quarter'];
        this.toward = unit(up === 'z' ? [side[0], -side[2], side[1]] : side);
        this.target = [0, 0, 0];
        this.distance = 5;
        this.fits = null;
        if (!camera) return;
        const back = minus(camera.eye, camera.target);
        this.toward = unit(back);
        this.target = camera.target;
        this.distance = length(back);
        if (Math.abs(camera.up[2]) > Math.abs(camera.up[1])) this.up = [0, 0, Math.sign(camera.up[2])];
    }

    // Cells side by side, each with its meshes; all in one unless the picture has columns.
    cells() {
        const meshes = this.drawn.meshes, columns = this.picture?.columns || 0;
        if (!columns || meshes.length < 2) return [{ meshes, box: this.picture?.box, hair: true, place: 0, x: 0, y: 0, w: 1, h: 1 }];
        const wide = this.canvas.clientWidth >= this.canvas.clientHeight;
        const across = wide ? Math.min(columns, meshes.length) : 1;
        const rows = Math.ceil(meshes.length / across);
        return meshes.map((mesh, i) => ({
            meshes: [mesh], box: this.picture.meshes[i].box, hair: false, place: i, caption: this.picture.meshes[i].caption,
            x: i % across / across, y: 1 - (Math.floor(i / across) + 1) / rows, w: 1 / across, h: 1 / rows,
        }));
    }

    frame() {
        const { picture } = this;
        if (!picture?.box) return;
        this.touched = false;
        this.resetCamera(picture);
        if (!picture.camera) this.fit();
    }

    // After a change of the free part: unless a hand or a script has chosen the view.
    fitAgain() {
        if (!this.touched && this.picture?.box && !this.picture.camera) this.fit();
        this.ask();
    }

    // Points that a view frames, of some meshes and of hair, at most about 20,000.
    framedPoints(meshes, strands) {
        const lists = [...meshes.map(one => ({ values: one.positions, width: 3, place: one.place })), ...strands.map(one => ({ values: one.points.subarray(4, one.points.length - 8), width: 4 }))];
        const stride = Math.ceil(lists.reduce((sum, { values, width }) => sum + values.length / width, 0) / 20000) || 1, points = [];
        for (const { values, width, place } of lists) {
            for (let i = 0; i + 2 < values.length; i += width * stride) {
                const p = [values[i], values[i + 1], values[i + 2]];
                points.push(place ? [0, 1, 2].map(k => place[k] * p[0] + place[4 + k] * p[1] + place[8 + k] * p[2] + place[12 + k]) : p);
            }
        }
        return points;
    }

    // The nearest camera along this direction that sees all points, as frame_points in kernel/sketch/camera.cpp.
    fitted(points, half, aspect) {
        const right = unit(cross(this.up, this.toward)), over = cross(this.toward, right), used = 0.88, tangents = [used * half * aspect, used * half];
        const high = [-Infinity, -Infinity], low = [-Infinity, -Infinity];
        let nearest = 1e-6;
        for (const p of points) {
            const depth = -dot(p, this.toward), at = [dot(p, right), dot(p, over)];
            for (let k = 0; k < 2; ++k) {
                high[k] = Math.max(high[k], at[k] - tangents[k] * depth);
                low[k] = Math.max(low[k], -at[k] - tangents[k] * depth);
            }
            nearest = Math.max(nearest, 1e-6 - depth);
        }
        const away = Math.max(nearest, ...[0, 1].map(k => 0.5 * (high[k] + low[k]) / tangents[k]));
        const middle = plus(right.map(x => 0.5 * (high[0] - low[0]) * x), over, 0.5 * (high[1] - low[1]));
        // The target lies as deep as the middle of the box, so that it is turned about that.
        const { low: a, high: b } = this.picture.box, deep = -dot(a.map((x, k) => 0.5 * (x + b[k])), this.toward);
        return { target: plus(middle, this.toward, -deep), distance: Math.max(away + deep, 1e-6) };
    }

    fit() {
        const cells = this.cells(), [cell] = cells, isRow = cells.length > 1, { picture, canvas } = this;
        const { left, right: beside, bottom } = isRow ? { left: 0, right: 0, bottom: 0 } : this.covered();
        const high = Math.max(canvas.clientHeight * cell.h - bottom, 1), aspect = Math.max(canvas.clientWidth * cell.w - left - beside, 1) / high;
        const half = Math.tan(this.fov / 2) * high / Math.max(canvas.clientHeight * cell.h, 1);
        const hair = isRow ? [] : picture.strands;
        const fits = isRow && picture.fit === 'each' ? picture.meshes.map(mesh => this.fitted(this.framedPoints([mesh], []), half, aspect))
            : [this.fitted(this.framedPoints(picture.meshes, hair), half, aspect)];
        Object.assign(this, fits[0]);
        this.fits = fits;
    }

    // The camera of a cell: each has its own share of what the hand does, or all have the same.
    cameraOf(place) {
        const first = this.fits?.[0], own = this.fits?.[place];
        if (!own || own === first) return { target: this.target, distance: this.distance };
        return { target: plus(own.target, minus(this.target, first.target)), distance: own.distance * this.distance / first.distance };
    }

    orbit(dx, dy) {
        const right = unit(cross(this.up, this.toward)), turn = (v, axis, a) => {
            const c = Math.cos(a), s = Math.sin(a), along = dot(axis, v) * (1 - c), side = cross(axis, v);
            return v.map((x, k) => c * x + s * side[k] + along * axis[k]);
        };
        this.toward = turn(this.toward, this.up, -dx);
        const tilted = turn(this.toward, right, -dy);
        if (Math.abs(dot(tilted, this.up)) < 0.999) this.toward = tilted;
        this.toward = unit(this.toward);
        this.ask();
    }

    pan(dx, dy) {
        const right = unit(cross(this.up, this.toward)), over = cross(this.toward, right);
        const step = 2 * this.distance * Math.tan(this.fov / 2) / Math.max(this.canvas.clientHeight, 1);
        this.target = plus(plus(this.target, right, -dx * step), over, dy * step);
        this.ask();
    }

    zoom(factor) {
        this.touched = true;
        this.distance = Math.max(this.distance * factor, 1e-6);
        this.ask();
    }

    listen() {
        const { canvas, fingers } = this;
        canvas.addEventListener('contextmenu', event => event.preventDefault());
        canvas.addEventListener('dblclick', () => { if (this.picture?.box && !this.hand?.isActive) { this.fit(); this.ask(); } });
        canvas.addEventListener('wheel', event => { event.preventDefault(); if (!this.hand?.wheel(event)) this.zoom(Math.exp(0.0012 * event.deltaY)); }, { passive: false });
        canvas.addEventListener('pointerdown', event => {
            try { canvas.setPointerCapture(event.pointerId); } catch { /* A pointer that has gone already. */ }
            if (this.hand?.down(event)) return;
            fingers.set(event.pointerId, event);
            this.moving = this.touched = true;
        });
        const lift = event => { if (this.hand?.up(event)) return; fingers.delete(event.pointerId); if (fingers.size === 0) { this.moving = false; this.ask(); } };
        canvas.addEventListener('pointerup', lift);
        canvas.addEventListener('pointercancel', lift);
        canvas.addEventListener('pointermove', event => {
            if (this.hand?.move(event)) return;
            const before = fingers.get(event.pointerId);
            if (!before) return;
            const dx = event.clientX - before.clientX, dy = event.clientY - before.clientY;
            const other = [...fingers.values()].find(one => one.pointerId !== event.pointerId);
            fingers.set(event.pointerId, event);
            if (other) {
                const spread = one => Math.hypot(one.clientX - other.clientX, one.clientY - other.clientY) || 1;
                this.zoom(spread(before) / spread(event));
                // With a tool, whose the first finger is, two turn the view and three move it.
                if (this.hand?.isActive && fingers.size === 2) this.orbit(0.004 * dx, 0.004 * dy); else this.pan(dx / fingers.size, dy / fingers.size);
            } else if (event.buttons & 4 || event.shiftKey || (event.buttons & 2 && !this.hand?.isActive)) {
                this.pan(dx, dy);
            } else {
                this.orbit(0.008 * dx, 0.008 * dy);
            }
        });
        canvas.addEventListener('keydown', event => {
            const step = { ArrowLeft: [-0.15, 0], ArrowRight: [0.15, 0], ArrowUp: [0, -0.15], ArrowDown: [0, 0.15] }[event.key];
            if (step) { event.preventDefault(); this.orbit(...step); }
            if (event.key === '+' || event.key === '-') this.zoom(event.key === '+' ? 0.85 : 1 / 0.85);
        });
    }

    // How much farther right than left of the free part, and below it, the picture goes.
    shift() {
        const { left, right, bottom } = this.covered();
        return { right: right - left, down: bottom };
    }

    // The camera as tools take it: its picture begins at the same corner, and the free part is in its middle.
    look() {
        const { target, toward, distance, up, canvas } = this, { right, down } = this.shift();
        const size = [Math.max(Math.round(canvas.clientWidth - right), 1), Math.max(Math.round(canvas.clientHeight - down), 1)];
        const half = Math.tan(this.fov / 2) * size[1] / Math.max(canvas.clientHeight, 1);
        return { eye: plus(target, toward, distance), target: [...target], up: [...up], fov: 2 * Math.atan(half) * 180 / Math.PI, size };
    }

    // A tool's camera.
    seeBy(camera) {
        const { up, picture, fov } = this;
        this.resetCamera({ up: picture?.up, camera });
        Object.assign(this, { up, fov, touched: true });
        this.ask();
    }

    // The pixel of a point of the world; null behind the camera.
    project(x, y, z) {
        if (!this.whole) return null;
        const m = this.whole, w = m[3] * x + m[7] * y + m[11] * z + m[15];
        if (!(w > 0)) return null;
        const across = (m[0] * x + m[4] * y + m[8] * z + m[12]) / w, over = (m[1] * x + m[5] * y + m[9] * z + m[13]) / w;
        return [(0.5 + 0.5 * across) * this.canvas.clientWidth, (0.5 - 0.5 * over) * this.canvas.clientHeight];
    }

    // ---- A frame

    ask() {
        if (this.asked) return;
        this.asked = requestAnimationFrame(() => { this.asked = 0; this.draw(); });
    }

    size() {
        // Hair is finer than the pixels of most screens.
        const { canvas } = this, scale = this.drawn.strands.length ? 2 : Math.min(window.devicePixelRatio || 1, 2);
        const width = Math.max(Math.round(canvas.clientWidth * scale), 1), height = Math.max(Math.round(canvas.clientHeight * scale), 1);
        if (canvas.width !== width || canvas.height !== height) { canvas.width = width; canvas.height = height; }
        return { width, height, scale };
    }

    draw() {
        const gl = this.gl, { width, height, scale } = this.size(), start = performance.now();
        this.isQuick &&= this.moving;
        gl.viewport(0, 0, width, height);
        gl.clearColor(0, 0, 0, 0);
        gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT);
        const cells = this.cells();
        for (const cell of cells) this.drawCell(cell, cells.length > 1, width, height, scale);
        // Where frames are slow, a view that moves has no occlusion. A pixel is read, so that the time is that of the frame.
        if (this.moving && !this.isQuick) {
            gl.readPixels(0, 0, 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, new Uint8Array(4));
            this.isQuick = performance.now() - start > 40;
        }
        this.frames = (this.frames || 0) + 1;
        this.changed(cells);
    }

    drawCell(cell, centred, width, height, scale) {
        const gl = this.gl, w = Math.round(cell.w * width), h = Math.round(cell.h * height);
        gl.viewport(Math.round(cell.x * width), Math.round(cell.y * height), w, h);
        const { target, distance } = this.cameraOf(cell.place);
        const view = lookAt(plus(target, this.toward, distance), target, this.up);
        const reach = cell.box ? length(minus(cell.box.high, cell.box.low)) + length(minus(target, cell.box.low)) : 1;
        const near = Math.max(distance - reach, 0.002 * distance);
        const projection = perspective(this.fov, w / h, near, distance + reach);
        // The middle of the picture is that of its free part.
        if (!centred) {
            const { right, down } = this.shift();
            projection[8] += right / Math.max(this.canvas.clientWidth, 1);
            projection[9] -= down / Math.max(this.canvas.clientHeight, 1);
        }
        const half = Math.tan(this.fov / 2);
        const openness = this.occlusion.compute(this.isQuick ? [] : cell.meshes, { view, projection, extent: [half * w / h, half], size: [w / scale, h / scale].map(x => Math.min(Math.round(x), 2048)), depth: p => dot(minus(plus(target, this.toward, distance), p), this.toward) });
        gl.viewport(Math.round(cell.x * width), Math.round(cell.y * height), w, h);
        const light = cell.hair ? this.drawn.strands.find(one => one.light)?.light : null;
        const shared = { view, projection, light, h, openness, corner: [Math.round(cell.x * width), Math.round(cell.y * height)], size: [w, h] };
        this.whole = centred ? null : times(projection, view);
        this.drawMeshes(cell.meshes, shared, scale);
        if (cell.hair) this.drawStrands(shared);
        if (cell.hair && this.drawn.lines) this.drawLines(shared, w, h, scale);
        for (const { balls, place } of cell.meshes) if (balls) this.drawBalls(balls, place, shared, w, h, scale);
        if (cell.hair && this.drawn.balls) this.drawBalls(this.drawn.balls, identity, shared, w, h, scale);
        gl.bindVertexArray(null);
    }

    useLight({ places }, { view, projection, light }, shadow, texture = light?.texture) {
        const gl = this.gl;
        gl.uniformMatrix4fv(places.u_view, false, view);
        gl.uniformMatrix4fv(places.u_projection, false, projection);
        gl.activeTexture(gl.TEXTURE0);
        gl.bindTexture(gl.TEXTURE_3D, light ? texture : this.noLight);
        gl.uniform1i(places.u_hair, 0);
        gl.uniform4fv(places.u_hair_grid, light ? [...light.origin, light.step] : [0, 0, 0, 0]);
        gl.uniform3fv(places.u_hair_size, light ? light.size : [1, 1, 1]);
        gl.uniform3fv(places.u_hair_color, light ? light.color : [0, 0, 0]);
        gl.uniform1f(places.u_shadow, shadow);
    }

    drawMeshes(meshes, shared, scale) {
        const gl = this.gl, { program, places } = this.mesh;
        gl.useProgram(program);
        this.useLight(this.mesh, shared, 1, shared.light?.onHead);
        gl.uniform1f(places.u_wire, this.settings.wire || this.picture?.wire ? scale : 0);
        gl.uniform1i(places.u_flat, this.settings.flat || this.picture?.flat ? 1 : 0);
        const { openness, corner, size } = shared, share = openness.size.map((x, k) => x / size[k]);
        this.useTexture(places.u_openness, 1, openness.texture);
        this.useTexture(places.u_colormap, 2, this.colormap);
        gl.activeTexture(gl.TEXTURE3);
        gl.bindTexture(gl.TEXTURE_3D, shared.light?.tinted || this.noTint);
        gl.uniform1i(places.u_tint, 3);
        gl.uniform2fv(places.u_openness_scale, share);
        gl.uniform2fv(places.u_openness_offset, share.map((x, k) => -x * corner[k]));
        for (const mesh of meshes) {
            gl.uniformMatrix4fv(places.u_place, false, mesh.place);
            gl.bindVertexArray(mesh.array);
            if (mesh.raised) { gl.enable(gl.POLYGON_OFFSET_FILL); gl.polygonOffset(-4, -4); } else gl.disable(gl.POLYGON_OFFSET_FILL);
            gl.drawArrays(gl.TRIANGLES, 0, mesh.count);
        }
        gl.disable(gl.POLYGON_OFFSET_FILL);
    }

    useTexture(place, unit, texture) {
        const gl = this.gl;
        gl.activeTexture(gl.TEXTURE0 + unit);
        gl.bindTexture(gl.TEXTURE_2D, texture);
        gl.uniform1i(place, unit);
    }

    // While the view moves fewer and wider strands are drawn, as far as frames are slow.
    drawStrands(shared) {
        const gl = this.gl, { program, places } = this.hair;
        if (this.drawn.strands.length === 0) return;
        gl.useProgram(program);
        const start = performance.now();
        const level = this.moving ? this.level || 1 : 1;
        for (const strands of this.drawn.strands) {
            this.useLight(this.hair, shared, strands.look.shadow);
            gl.uniform4fv(places.u_lobes, strands.look.lobes);
            gl.uniform1f(places.u_wide, 1 / Math.sqrt(level));
            gl.uniform1f(places.u_thinnest, 0.25 * 2 * Math.tan(this.fov / 2) / shared.h);
            gl.bindVertexArray(strands.array);
            gl.drawElements(gl.TRIANGLES, strands.ends[Math.floor(level * (strands.ends.length - 1))], gl.UNSIGNED_INT, 0);
        }
        if (!this.moving) return;
        // A pixel is read, so that the time is that of the frame.
        gl.readPixels(0, 0, 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, new Uint8Array(4));
        const ms = performance.now() - start;
        if (ms > 40) this.level = Math.max(0.08, level * 30 / ms);
        else if (ms < 12) this.level = Math.min(1, level * 1.25);
    }

    drawLines(shared, w, h, scale) {
        const gl = this.gl, { program, places } = this.line, { lines } = this.drawn;
        gl.useProgram(program);
        gl.uniformMatrix4fv(places.u_view, false, shared.view);
        gl.uniformMatrix4fv(places.u_projection, false, shared.projection);
        gl.uniform2f(places.u_pixel, 2 / w, 2 / h);
        gl.uniform1f(places.u_width, 4 * scale);
        gl.bindVertexArray(lines.array);
        gl.drawArraysInstanced(gl.TRIANGLE_STRIP, 0, 4, lines.count);
    }

    drawBalls(balls, place, shared, w, h, scale) {
        const gl = this.gl, { program, places } = this.ball;
        gl.useProgram(program);
        gl.uniformMatrix4fv(places.u_view, false, shared.view);
        gl.uniformMatrix4fv(places.u_projection, false, shared.projection);
        gl.uniformMatrix4fv(places.u_place, false, place);
        gl.uniform2f(places.u_pixel, 2 / w, 2 / h);
        gl.uniform1f(places.u_radius, 6 * scale);
        gl.uniform1f(places.u_depth, 2 * Math.tan(this.fov / 2) / h);
        gl.bindVertexArray(balls.array);
        gl.drawArraysInstanced(gl.TRIANGLE_STRIP, 0, 4, balls.count);
    }

    // The picture as it is seen, as PNG with a background.
    async png(background) {
        this.draw();
        const flat = document.createElement('canvas');
        flat.width = this.canvas.width;
        flat.height = this.canvas.height;
        const context = flat.getContext('2d');
        context.fillStyle = background || css('white');
        context.fillRect(0, 0, flat.width, flat.height);
        context.drawImage(this.canvas, 0, 0);
        return new Promise(resolve => flat.toBlob(resolve, 'image/png'));
    }
}
