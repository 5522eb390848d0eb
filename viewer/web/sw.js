// Keeps the page for visits without a network. The list of files and the version are filled in by build.mjs.
const version = 'lissom-@VERSION@', files = @FILES@;

self.addEventListener('install', event => event.waitUntil(
    caches.open(version).then(cache => cache.addAll(files)).then(() => self.skipWaiting())));

self.addEventListener('activate', event => event.waitUntil(
    caches.keys().then(names => Promise.all(names.filter(name => name.startsWith('lissom-') && name !== version).map(name => caches.delete(name))))
        .then(() => self.clients.claim())));

self.addEventListener('fetch', event => {
    if (event.request.method !== 'GET') return;
    event.respondWith(caches.match(event.request, { ignoreSearch: true }).then(found => found || fetch(event.request)));
});
