// Markdown of the docs as HTML: headings with anchors, Lua in colours, links to pages of the site.
import { createRequire } from 'node:module';
import path from 'node:path';

const escaped = text => text.replace(/&/g, '&amp;').replace(/</g, '&lt;').replace(/>/g, '&gt;').replace(/"/g, '&quot;');

// As GitHub makes them, so that links of the docs hold in both places.
const slug = text => text.toLowerCase().replace(/<[^>]*>/g, '').replace(/[^\p{L}\p{N}\s_-]/gu, '').trim().replace(/\s/g, '-');

function luaColors(npm) {
    const require = createRequire(path.join(npm, 'package.json'));
    const { StreamLanguage } = require('@codemirror/language'), { lua } = require('@codemirror/legacy-modes/mode/lua');
    const { classHighlighter, highlightCode } = require('@lezer/highlight');
    const parser = StreamLanguage.define(lua).parser;
    return code => {
        let html = '';
        highlightCode(code, parser.parse(code), classHighlighter,
            (text, classes) => { html += classes ? `<span class="${classes}">${escaped(text)}</span>` : escaped(text); },
            () => { html += '\n'; });
        return html;
    };
}

// render(text, { link, image, example }): the HTML, and its sections as { id, title, depth, text } for the search.
//   link(href) and image(href) return the address in the site, or null if there is none;
//   example(code, anchor) returns HTML that follows a block of Lua.
export function makeRenderer(npm) {
    const { Marked } = createRequire(path.join(npm, 'package.json'))('marked');
    const colored = luaColors(npm);
    return (text, { link, image, example }) => {
        const sections = [], used = new Set();
        let anchor = '';
        const unique = id => { let one = id, n = 0; while (used.has(one)) one = `${id}-${++n}`; used.add(one); return one; };
        const plain = tokens => (tokens || []).map(token => token.tokens ? plain(token.tokens) : token.text || '').join('');
        const renderer = {
            heading({ tokens, depth }) {
                const title = plain(tokens), id = unique(slug(title));
                sections.push({ id: depth === 1 ? '' : anchor && depth === 3 ? anchor : id, title, depth, text: '' });
                const inner = this.parser.parseInline(tokens);
                return `<h${depth} id="${id}">${inner}<a class="anchor" href="#${id}" aria-label="Link to this section">#</a></h${depth}>\n`;
            },
            html({ text: html }) {
                const found = /<a id="([^"]+)">/.exec(html);
                if (found) anchor = found[1];
                return /^<!--/.test(html.trim()) ? '' : html;
            },
            paragraph({ tokens }) {
                const last = sections[sections.length - 1];
                if (last && last.text.length < 220) last.text += `${plain(tokens).replace(/\s+/g, ' ')} `;
                return `<p>${this.parser.parseInline(tokens)}</p>\n`;
            },
            link({ href, tokens }) {
                const inner = this.parser.parseInline(tokens), to = link(href);
                return to === null ? inner : `<a href="${escaped(to)}">${inner}</a>`;
            },
            image({ href, text: alt }) {
                const to = image(href);
                return to === null ? '' : `<img src="${escaped(to)}" alt="${escaped(alt)}" loading="lazy">`;
            },
            code({ text: code, lang }) {
                const html = lang === 'lua' ? colored(code) : escaped(code);
                const block = `<pre class="code"><code>${html}</code></pre>`;
                return lang === 'lua' ? `<div class="example">${block}${example(code, anchor) || ''}</div>\n` : `${block}\n`;
            },
        };
        const html = new Marked({ renderer }).parse(text).replace(/<table>/g, '<div class="table"><table>').replace(/<\/table>/g, '</table></div>');
        return { html, sections };
    };
}

export { escaped, slug };
