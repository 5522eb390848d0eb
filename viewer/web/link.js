// A script and its values as the end of a link, and back: JSON, deflated, in the letters of base64url.
const through = async (bytes, stream) => new Uint8Array(await new Response(new Blob([bytes]).stream().pipeThrough(stream)).arrayBuffer());

// `picture`: the name of the one that is shown first.
export async function toLink({ script, values, name, picture }) {
    const bytes = await through(new TextEncoder().encode(JSON.stringify({ s: script, v: values, n: name, p: picture })), new CompressionStream('deflate-raw'));
    let text = '';
    for (const byte of bytes) text += String.fromCharCode(byte);
    return btoa(text).replace(/\+/g, '-').replace(/\//g, '_').replace(/=+$/, '');
}

// Throws if the link is not whole.
export async function fromLink(text) {
    const bytes = Uint8Array.from(atob(text.replace(/-/g, '+').replace(/_/g, '/')), c => c.charCodeAt(0));
    const { s, v, n, p } = JSON.parse(new TextDecoder().decode(await through(bytes, new DecompressionStream('deflate-raw'))));
    if (typeof s !== 'string') throw new Error('the link holds no script');
    return { script: s, values: v && typeof v === 'object' ? v : {}, name: typeof n === 'string' ? n : 'script.lua', picture: typeof p === 'string' ? p : null };
}
