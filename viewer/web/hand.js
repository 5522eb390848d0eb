// The hand of a page: mouse, pen and finger for the tool that it has taken, and keys. Inputs wait here until the worker
// has done all before: no motion is left out, as a stroke is its whole course.
const clickReach = 6, fingerWait = 90;     // pixels, ms

// The name of a key as tools know it; a letter that is not Latin has that of the Latin letter on its key.
export function keyName(event) {
    const named = { Enter: 'enter', Tab: 'tab', Backspace: 'backspace', Delete: 'delete', ' ': 'space', Escape: 'escape' };
    return named[event.key] || letterOf(event);
}

// The letter of the layout, in lower case; that of the key in layouts of other scripts; empty for other keys.
export function letterOf(event) {
    if (event.key.length !== 1) return '';
    if (event.key.charCodeAt(0) < 127) return event.key.toLowerCase();
    return /^Key[A-Z]$/.test(event.code) ? event.code[3].toLowerCase() : '';
}

// Mice and most fingers tell none, or a constant. A pen that is lifted, or tells none, presses by 0.
const pressureOf = ({ pointerType, pressure }) => pointerType === 'pen' && pressure > 0 ? { pressure: Math.min(pressure, 1) } : {};
const modifiersOf = event => ({ shift: event.shiftKey, ctrl: event.ctrlKey || event.metaKey, alt: event.altKey });

export class Hand {
    // `post` sends a message to the worker; its answer is followed by `answered`.
    constructor(view, post) {
        Object.assign(this, { view, post, tool: '', kept: {}, sticky: { shift: false, ctrl: false }, at: 0 });
        this.isBlocked = () => false;
        this.reset();
        view.hand = this;
        window.addEventListener('keydown', event => { if (event.key === 'Control') this.isCtrlDown = true; });
        window.addEventListener('keyup', event => { if (event.key === 'Control') this.isCtrlDown = false; });
        window.addEventListener('blur', () => { this.isCtrlDown = false; });
    }

    // A new document: inputs that wait are for the one before.
    reset() {
        this.view.moving = false;
        Object.assign(this, { queue: [], isWaiting: false, isFresh: true, pointer: null, finger: null, look: '', inHand: '' });
    }

    get isActive() { return this.tool !== '' && !this.isBlocked(); }

    get isBusy() { return this.pointer !== null || this.isWaiting || this.queue.length > 0; }

    // ---- Inputs that wait

    put(input) {
        if (this.isBlocked()) return;
        this.putLook();
        this.queue.push(input);
        this.send();
    }

    // The camera of the picture, if it is another than the tool sees by.
    putLook() {
        const look = this.view.look(), text = JSON.stringify(look);
        if (text === this.look) return;
        this.look = text;
        const last = this.queue.length - 1;
        if (last >= 0 && this.queue[last].kind === 'look') this.queue.pop();
        this.queue.push({ kind: 'look', ...look });
    }

    // The picture was drawn; a tool's marks may hang on how it is seen.
    drawn() {
        if (!this.inHand || this.isBlocked() || this.pointer) return;
        this.putLook();
        this.send();
    }

    send() {
        if (this.isWaiting || !this.queue.length || this.isBlocked()) return;
        const inputs = this.queue.splice(0);
        inputs.forEach((input, i) => {
            const next = inputs[i + 1];
            if (input.kind !== 'move' || next?.kind !== 'move') return;
            if (['shift', 'ctrl', 'alt'].every(key => input.event[key] === next.event[key])) input.event.late = true;
        });
        this.isWaiting = true;
        this.post({ at: this.at, inputs, fresh: this.isFresh });
        this.isFresh = false;
    }

    answered() {
        this.isWaiting = false;
        this.send();
        this.tick();
    }

    // For what moves by itself while the button is down.
    tick() {
        clearTimeout(this.clock);
        if (this.pointer === null || !this.last?.ticks) return;
        const seconds = (performance.now() - this.ticked) / 1000;
        if (seconds < 0.033) { this.clock = setTimeout(() => this.tick(), 34 - 1000 * seconds); return; }
        this.ticked = performance.now();
        this.put({ kind: 'tick', event: { seconds: Math.min(seconds, 0.25) } });
    }

    // ---- The tool

    take(tool) {
        this.tool = tool;
        this.sticky = { shift: false, ctrl: false };
        this.takeAgain();
    }

    // Also in a new document, with the values that it had.
    takeAgain() {
        if (this.tool === this.inHand || this.isBlocked()) return;
        this.inHand = this.tool;
        this.put({ kind: 'use', tool: this.tool });
        for (const [name, value] of Object.entries(this.kept[this.tool] || {})) this.put({ kind: 'set', name, value });
    }

    set(name, value) {
        (this.kept[this.tool] ??= {})[name] = value;
        const last = this.queue[this.queue.length - 1];
        if (last?.kind === 'set' && last.name === name) last.value = value; else this.put({ kind: 'set', name, value });
    }

    key(key, modifiers = {}) {
        if (key === 'escape') { this.letGo(); this.put({ kind: 'cancel' }); } else this.put({ kind: 'key', event: { key, ...modifiers } });
    }

    travel(kind) { this.letGo(); this.put({ kind }); }

    letGo() {
        if (this.pointer !== null) { this.view.moving = false; this.view.ask(); }
        this.pointer = this.finger = null;
    }

    // ---- Pointers; each function returns whether the event was the tool's

    place(event) {
        const box = this.view.canvas.getBoundingClientRect(), { shift, ctrl, alt } = modifiersOf(event);
        return { x: event.clientX - box.left, y: event.clientY - box.top, ...pressureOf(event),
            shift: shift || this.sticky.shift, ctrl: ctrl || this.sticky.ctrl, alt };
    }

    down(event) {
        if (!this.isActive || this.view.fingers.size > 0) return false;
        if (event.pointerType === 'touch') return this.touch(event);
        if (this.pointer !== null) return true;
        if (event.button !== 0 || event.altKey) return false;
        this.press(event);
        return true;
    }

    press(event) {
        this.pointer = event.pointerId;
        this.ticked = performance.now();
        // A view that one works in stays; meanwhile hair is drawn as when it turns.
        this.view.touched = this.view.moving = true;
        this.put({ kind: 'press', event: { ...this.place(event), button: 'left' } });
    }

    // The first finger is the tool's once it moves or stays; with a second one both turn the view.
    touch(event) {
        if (this.penIsDown) return true;
        if (this.pointer === null && !this.finger) {
            const finger = this.finger = { first: event, last: event };
            setTimeout(() => { if (this.finger === finger) this.pressFinger(); }, fingerWait);
            return true;
        }
        const first = this.finger ? this.finger.last : this.lastTouch;
        if (this.pointer !== null) this.put({ kind: 'cancel' });
        this.letGo();
        if (first) this.view.fingers.set(first.pointerId, first);
        return false;
    }

    pressFinger() {
        const { first, last } = this.finger;
        this.finger = null;
        this.lastTouch = last;
        this.press(first);
        if (last !== first) this.put({ kind: 'move', event: this.place(last) });
    }

    move(event) {
        if (this.finger?.first.pointerId === event.pointerId) {
            const { first } = this.finger;
            this.finger.last = event;
            if (Math.hypot(event.clientX - first.clientX, event.clientY - first.clientY) >= clickReach) this.pressFinger();
            return true;
        }
        const isHeld = this.pointer === event.pointerId;
        if (!isHeld && (!this.isActive || this.pointer !== null || this.view.fingers.size > 0 || event.pointerType === 'touch')) return false;
        if (isHeld) this.lastTouch = event;
        const all = event.getCoalescedEvents?.() || [];
        const { shift, ctrl, alt } = this.place(event);
        for (const one of all.length ? all : [event]) this.put({ kind: 'move', event: { ...this.place(one), shift, ctrl, alt } });
        this.isAway = false;
        return isHeld;
    }

    up(event) {
        if (this.finger?.first.pointerId === event.pointerId) this.pressFinger();
        if (this.pointer !== event.pointerId) return false;
        if (event.pointerType !== 'touch' && event.button !== 0 && event.type === 'pointerup') return true;
        this.letGo();
        if (event.type === 'pointercancel') this.put({ kind: 'cancel' }); else this.put({ kind: 'release', event: this.place(event) });
        if (event.pointerType === 'touch') this.isAway = true;
        return true;
    }

    // While the button is down, or with Ctrl. Two fingers on a pad that spread come as a wheel with Ctrl, too.
    wheel(event) {
        const isOwn = this.isActive && (this.pointer !== null || (event.ctrlKey && this.isCtrlDown));
        if (!isOwn) return false;
        const turn = -(event.deltaY || event.deltaX) / (event.deltaMode === 0 ? 100 : 3);
        this.put({ kind: 'wheel', event: { ...this.place(event), lines: turn } });
        return true;
    }
}
