// SPDX-License-Identifier: BSD-3-Clause
// A web site on another origin, whose page tries to reach the live view.
import { once } from 'node:events';
import { createServer } from 'node:http';

/** Serves an empty page to whatever name it is asked by. @return Its port and an end. */
export async function startSite() {
  const server = createServer((_request, response) => response.end('<!doctype html><title>another site</title>'));
  server.listen(0, '127.0.0.1');
  await once(server, 'listening');
  return { port: server.address().port, stop: () => server.close() };
}

/**
 * What a page gets from the live view: of the WebSocket "opened" or "refused", of the rest what it could read, "nothing" or, of what it may
 * not look into, "opaque". Runs in the page.
 */
export async function reach(view) {
  const read = async (path, options) => {
    try {
      const answer = await fetch(view + path, options);
      return answer.type === 'opaque' ? 'opaque' : await answer.text();
    } catch {
      return 'nothing';
    }
  };
  const socket = await new Promise((resolve) => {
    const tried = new WebSocket(`${view.replace('http', 'ws')}live`, 'disflow.v1');
    tried.onopen = () => {
      // Were it let in, it would forget the object.
      tried.send(new Uint8Array([1, 0, 0, 0]));
      resolve('opened');
    };
    tried.onerror = () => resolve('refused');
  });
  const credentials = 'include';
  return {
    socket,
    page: await read('', { credentials }),
    metrics: await read('metrics', { credentials }),
    hidden: await read('metrics', { credentials, mode: 'no-cors' }),
  };
}
