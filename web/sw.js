// Keeps the page for use without a connection. The build puts in the list of its files and a number for it; what few need
// is not in the list, and kept from its first use on.
const version = '__VERSION__';
const files = __FILES__;

addEventListener('install', (event) => {
  event.waitUntil(caches.open(version).then((cache) => cache.addAll(files)));
});

addEventListener('activate', (event) => {
  const drop = async () => {
    const names = await caches.keys();
    await Promise.all(
      names.filter((n) => n.startsWith('dualblock ') && n !== version).map((n) => caches.delete(n)),
    );
    await self.clients.claim();
  };
  event.waitUntil(drop());
});

const fetched = async (request) => {
  const response = await fetch(request);
  if (response.ok && request.url.includes('/assets/'))
    await (await caches.open(version)).put(request, response.clone());
  return response;
};

// The page itself comes from the network where there is one, so that a new version is seen; all else has its contents'
// hash in its name, or belongs to the page's version.
addEventListener('fetch', (event) => {
  const { request } = event;
  if (request.method !== 'GET' || new URL(request.url).origin !== location.origin) return;
  const cached = () => caches.match(request, { ignoreSearch: true });
  const answer = async () => {
    if (request.mode === 'navigate')
      return fetch(request).catch(async () => (await cached()) ?? caches.match('./'));
    return (await cached()) ?? fetched(request);
  };
  event.respondWith(answer());
});
