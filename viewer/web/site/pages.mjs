// The HTML around the content of a page.
import { escaped } from './markdown.mjs';

const logo = '<svg viewBox="0 0 32 32" aria-hidden="true"><path d="M9 28C9 12 21 20 23 4" fill="none" stroke="currentColor" stroke-width="5" stroke-linecap="round"/></svg>';
const top = [['guide/index.html', 'Guide'], ['reference/index.html', 'Reference'], ['gallery.html', 'Gallery'], ['playground/', 'Playground']];

export function pageHtml({ title, body, side = '', up, here }) {
    const room = here.split('/')[0];
    const links = top.map(([href, name]) => `<a href="${up}${href}"${href.split('/')[0] === room ? ' aria-current="true"' : ''}>${name}</a>`).join('');
    return `<!doctype html>
<html lang="en" data-up="${up}">
<head>
<meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<title>${escaped(title)}${title === 'Lissom' ? '' : ' · Lissom'}</title>
<meta name="description" content="Lissom: bend, merge and groom detailed shapes by short scripts.">
<link rel="icon" href="${up}icon.svg" type="image/svg+xml">
<link rel="stylesheet" href="${up}site.css">
<script>try { const t = localStorage.getItem('lissom.theme'); if (t) document.documentElement.dataset.theme = t; } catch {}</script>
<script type="module" src="${up}site.js"></script>
</head>
<body>
<a class="skip" href="#main">To the content</a>
<header>
<a class="name" href="${up}index.html">${logo}<span>Lissom</span></a>
<nav aria-label="Site">${links}</nav>
<form class="search" role="search"><input type="search" placeholder="Search" aria-label="Search" autocomplete="off" spellcheck="false"><div class="found" role="listbox" hidden></div></form>
<button type="button" id="theme" aria-label="Light or dark" title="Light or dark"><svg viewBox="0 0 16 16" aria-hidden="true"><circle cx="8" cy="8" r="6" fill="none" stroke="currentColor" stroke-width="1.5"/><path d="M8 2a6 6 0 0 1 0 12z" fill="currentColor"/></svg></button>
</header>
<div class="page${side ? ' sided' : ''}">${side ? `<details class="side"><summary>Pages</summary>${side}</details>` : ''}
<main id="main">
${body}
</main>
</div>
<footer><a href="${up}index.html">Lissom</a> · MIT licence · <a href="${up}guide/licence.html">Licences</a> · <a href="${up}guide/build.html">Build</a></footer>
</body>
</html>
`;
}

export function sideHtml(groups, here) {
    return `<nav aria-label="Pages">${groups.map(({ title, links }) => `<h2>${escaped(title)}</h2>${links.map(([page, name]) => `<a href="../${page}"${page === here ? ' aria-current="page"' : ''}>${escaped(name)}</a>`).join('')}`).join('')}</nav>`;
}

const pictureOf = one => `<img src="pictures/${one.id}.png" alt="" loading="lazy" width="480" height="360">`;

export function cardHtml(one, levels) {
    return `<article class="card" id="${one.id}" data-level="${one.level}"><a class="picture" href="playground/#gallery/${one.id}" aria-label="Open ${escaped(one.title)} in the playground">${pictureOf(one)}</a>
<h3>${escaped(one.title)}</h3><p>${escaped(one.text).replace(/`([^`]+)`/g, '<code>$1</code>')}</p><footer><span class="level ${one.level}">${levels[one.level]}</span>${one.more ? `<a href="${one.more}">Reference</a>` : ''}<a href="playground/#gallery/${one.id}">Open in the playground</a></footer></article>`;
}

export function slideHtml(one) {
    return `<article class="card"><a class="picture" href="playground/#gallery/${one.id}" aria-label="Open ${escaped(one.title)} in the playground">${pictureOf(one)}</a><h3>${escaped(one.title)}</h3></article>`;
}

export function liveHtml(one, title, text) {
    return `<article class="live"><h2>${title}</h2><p>${text}</p><div class="stage">${pictureOf(one)}<button type="button" data-live="${one.id}">Try it here</button></div></article>`;
}
