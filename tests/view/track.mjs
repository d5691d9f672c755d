// SPDX-License-Identifier: BSD-3-Clause
// Runs disflow_track with its live view.
import { spawn } from 'node:child_process';
import { once } from 'node:events';

/** @param port 0: any that is free. @param query Behind the view's address. */
export async function startTrack([sensor], { port = 0, query = '', more = [] } = {}) {
  const options = ['--sensor', sensor, '--rate', 'realtime', '--headless', '--view', `127.0.0.1:${port}${query}`, ...more];
  const child = spawn(process.env.DISFLOW_TRACK, options, { stdio: ['ignore', 'ignore', 'pipe'] });
  const ended = once(child, 'exit');
  let said = '';
  child.stderr.setEncoding('utf8');
  const url = await new Promise((resolve, reject) => {
    child.stderr.on('data', (text) => {
      said += text;
      const found = said.match(/live view: (http:\/\/[\d.]+:(\d+)\/)(\S*)\n/);
      if (found) resolve(found);
    });
    child.on('exit', () => reject(new Error(`disflow_track ended: ${said}`)));
  });
  const stop = async () => {
    child.kill('SIGINT');
    await ended;
  };
  // `url` is the page's, `address` what was printed.
  return { url: url[1], address: url[1] + url[3], port: Number(url[2]), stop };
}
