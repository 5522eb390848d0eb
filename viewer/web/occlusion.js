// How open each point of a picture is to its surroundings, from depths and normals, as viewer/render/gl/occlusion.h.
import { blurFragment, coverVertex, geometryFragment, geometryVertex, occlusionFragment } from './shaders.js';

// The radius: a share of the scene's RMS distance to its middle, and at most a share of the height that is seen.
const ofSize = 0.60, ofView = 0.20;

export class Occlusion {
    // `compiled(gl, vertex, fragment)` makes a program. Without textures of floats everything is open.
    constructor(gl, compiled) {
        this.gl = gl;
        this.nothing = this.texture(gl.RG8, 1, 1, gl.RG, gl.UNSIGNED_BYTE, new Uint8Array([255, 0]));
        this.works = Boolean(gl.getExtension('EXT_color_buffer_float'));
        if (!this.works) return;
        this.geometry = compiled(gl, geometryVertex, geometryFragment);
        this.occlusion = compiled(gl, coverVertex, occlusionFragment);
        this.blur = compiled(gl, coverVertex, blurFragment);
        this.empty = gl.createVertexArray();
        this.size = [0, 0];
    }

    texture(format, width, height, kind, type, texels = null) {
        const gl = this.gl, texture = gl.createTexture();
        gl.bindTexture(gl.TEXTURE_2D, texture);
        gl.texImage2D(gl.TEXTURE_2D, 0, format, width, height, 0, kind, type, texels);
        for (const axis of [gl.TEXTURE_WRAP_S, gl.TEXTURE_WRAP_T]) gl.texParameteri(gl.TEXTURE_2D, axis, gl.CLAMP_TO_EDGE);
        for (const filter of [gl.TEXTURE_MIN_FILTER, gl.TEXTURE_MAG_FILTER]) gl.texParameteri(gl.TEXTURE_2D, filter, gl.NEAREST);
        return texture;
    }

    target(format, kind, hasDepth) {
        const gl = this.gl, [width, height] = this.size, frame = gl.createFramebuffer(), texture = this.texture(format, width, height, kind, gl.FLOAT);
        gl.bindFramebuffer(gl.FRAMEBUFFER, frame);
        gl.framebufferTexture2D(gl.FRAMEBUFFER, gl.COLOR_ATTACHMENT0, gl.TEXTURE_2D, texture, 0);
        if (!hasDepth) return { frame, texture };
        const depth = gl.createRenderbuffer();
        gl.bindRenderbuffer(gl.RENDERBUFFER, depth);
        gl.renderbufferStorage(gl.RENDERBUFFER, gl.DEPTH_COMPONENT24, width, height);
        gl.framebufferRenderbuffer(gl.FRAMEBUFFER, gl.DEPTH_ATTACHMENT, gl.RENDERBUFFER, depth);
        return { frame, texture, depth };
    }

    // Targets of this size; those of another go.
    resize(size) {
        const gl = this.gl;
        if (this.size.every((x, k) => x === size[k])) return;
        for (const { frame, texture, depth } of this.targets || []) {
            gl.deleteFramebuffer(frame);
            gl.deleteTexture(texture);
            if (depth) gl.deleteRenderbuffer(depth);
        }
        this.size = size;
        this.targets = [this.target(gl.RGBA32F, gl.RGBA, true), this.target(gl.RG32F, gl.RG, false), this.target(gl.RG32F, gl.RG, false)];
    }

    radius(meshes, { extent, depth }) {
        let count = 0, square = 0;
        const sum = [0, 0, 0];
        for (const { moments } of meshes) {
            count += moments.count;
            square += moments.square;
            for (let k = 0; k < 3; ++k) sum[k] += moments.sum[k];
        }
        const center = sum.map(x => x / Math.max(count, 1)), spread = square / Math.max(count, 1) - center.reduce((all, x) => all + x * x, 0);
        return Math.min(ofSize * Math.sqrt(Math.max(spread, 0)), ofView * 2 * extent[1] * Math.max(depth(center), 0));
    }

    cover(program, target, textures) {
        const gl = this.gl;
        gl.bindFramebuffer(gl.FRAMEBUFFER, target.frame);
        gl.useProgram(program.program);
        Object.entries(textures).forEach(([name, texture], unit) => {
            gl.activeTexture(gl.TEXTURE0 + unit);
            gl.bindTexture(gl.TEXTURE_2D, texture);
            gl.uniform1i(program.places[name], unit);
        });
    }

    // Returns { texture, size }: openness and depth of each pixel. `extent`: half the width and height of the view at depth
    // 1; `depth(point)`: the depth of a point of the world. The viewport is another afterwards.
    compute(meshes, { view, projection, extent, size, depth }) {
        const gl = this.gl, radius = this.works && meshes.length ? this.radius(meshes, { extent, depth }) : 0;
        if (!(radius > 0)) return { texture: this.nothing, size: [1, 1] };
        this.resize(size);
        const [geometry, open, half] = this.targets;
        gl.bindFramebuffer(gl.FRAMEBUFFER, geometry.frame);
        gl.viewport(0, 0, ...size);
        gl.clearColor(0, 0, 0, 0);
        gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT);
        gl.useProgram(this.geometry.program);
        gl.uniformMatrix4fv(this.geometry.places.u_view, false, view);
        gl.uniformMatrix4fv(this.geometry.places.u_projection, false, projection);
        for (const mesh of meshes) {
            gl.uniformMatrix4fv(this.geometry.places.u_place, false, mesh.place);
            gl.bindVertexArray(mesh.array);
            gl.drawArrays(gl.TRIANGLES, 0, mesh.count);
        }
        gl.disable(gl.DEPTH_TEST);
        gl.bindVertexArray(this.empty);
        this.cover(this.occlusion, open, { u_normal_depth: geometry.texture });
        gl.uniform2fv(this.occlusion.places.u_extent, extent);
        gl.uniform1f(this.occlusion.places.u_radius, radius);
        gl.drawArrays(gl.TRIANGLES, 0, 3);
        for (const [from, to, step] of [[open, half, [1, 0]], [half, open, [0, 1]]]) {
            this.cover(this.blur, to, { u_openness_depth: from.texture, u_normal_depth: geometry.texture });
            gl.uniform2iv(this.blur.places.u_step, step);
            gl.uniform1f(this.blur.places.u_radius, radius);
            gl.drawArrays(gl.TRIANGLES, 0, 3);
        }
        gl.enable(gl.DEPTH_TEST);
        gl.bindFramebuffer(gl.FRAMEBUFFER, null);
        return { texture: open.texture, size };
    }
}
