// SPDX-License-Identifier: BSD-3-Clause
// The live view in a real browser: node --test view_test.mjs, with DISFLOW_TRACK, DISFLOW_CHROMIUM and a folder for pictures in
// DISFLOW_PICTURES.
import assert from 'node:assert/strict';
import { mkdirSync, mkdtempSync, rmSync } from 'node:fs';
import { readFile } from 'node:fs/promises';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { after, afterEach, before, beforeEach, test } from 'node:test';
import { chromium } from 'playwright-core';
import { reach, startSite } from './other_site.mjs';
import { startTrack } from './track.mjs';
import { distance, errorOf, placeOf, poseOf, rowsOf, truthOf } from './truth.mjs';

const kPatience_ms = 90_000;
const kToken = 'a-token-for-the-test';
const kKnown = ['--view-token', kToken];
const kDemo = 'sim:bottle?frames=20000&motion=fast&noise=white';
const pictures = process.env.DISFLOW_PICTURES;

let browser;
let track;
let page;
let complaints;

before(async () => {
  mkdirSync(pictures, { recursive: true });
  browser = await chromium.launch({
    executablePath: process.env.DISFLOW_CHROMIUM,
    // WebGL is drawn by the processor; the page around it is put together without it, which takes a tenth of the time.
    args: ['--no-sandbox', '--use-angle=swiftshader', '--enable-unsafe-swiftshader', '--disable-gpu-compositing'],
  });
});
after(() => browser?.close());

beforeEach(() => {
  complaints = [];
});
afterEach(async () => {
  await page?.context().close();
  await track?.stop();
  page = track = null;
});

async function open(url, options = {}) {
  const context = await browser.newContext({ viewport: { width: 1100, height: 800 }, ...options });
  page = await context.newPage();
  page.setDefaultTimeout(kPatience_ms);
  page.on('pageerror', (error) => complaints.push(error.message));
  page.on('console', (message) => {
    if (message.type() === 'error') complaints.push(message.text());
  });
  await page.goto(url);
}

const valueOf = (name) => page.textContent(`#values dd[data-name="${name}"]`);
const frame = async () => Number(await valueOf('Frame'));
const until = (condition, argument) => page.waitForFunction(condition, argument, { timeout: kPatience_ms });
const untilTracking = () =>
  until(() => ['tracking', 'degraded'].includes(document.getElementById('state').dataset.state) &&
    Number(document.getElementById('scene').dataset.triangles) > 500);
const untilFrameAfter = (number) =>
  until((than) => Number(document.querySelector('#values dd[data-name="Frame"]')?.textContent) > than, number);
const untilBanner = (text) =>
  until((part) => {
    const banner = document.getElementById('banner');
    return part ? !banner.hidden && banner.textContent.includes(part) : banner.hidden;
  }, text);

/** How many colours an element shows, counted in coarse steps. */
async function coloursOf(selector) {
  const clip = await page.locator(selector).boundingBox();
  const png = await page.screenshot({ clip, timeout: kPatience_ms });
  return page.evaluate(async (data) => {
    const image = new Image();
    image.src = `data:image/png;base64,${data}`;
    await image.decode();
    const canvas = new OffscreenCanvas(image.width, image.height);
    const context = canvas.getContext('2d');
    context.drawImage(image, 0, 0);
    const { data: bytes } = context.getImageData(0, 0, image.width, image.height);
    const seen = new Set();
    for (let i = 0; i < bytes.length; i += 4) seen.add((bytes[i] >> 4) * 256 + (bytes[i + 1] >> 4) * 16 + (bytes[i + 2] >> 4));
    return seen.size;
  }, png.toString('base64'));
}

const plotPictures = () => page.$$eval('.plot canvas', (all) => all.map((canvas) => canvas.toDataURL()));

test('the page shows a tracked object, and its plots move', async () => {
  track = await startTrack([kDemo]);
  await open(track.address);
  await untilTracking();
  await until(() => document.getElementById('depth').width > 100);
  assert.ok((await coloursOf('#view')) > 30, 'the scene shows no surface');
  assert.ok((await coloursOf('#depth')) > 8, 'the depth image shows nothing');
  const earlier = await plotPictures();
  assert.equal(earlier.length, 4);
  await untilFrameAfter((await frame()) + 20);
  const later = await plotPictures();
  later.forEach((picture, i) => assert.notEqual(picture, earlier[i], `plot ${i} stands still`));
  await page.screenshot({ path: `${pictures}/light.png`, timeout: kPatience_ms });
  assert.deepEqual(complaints, []);
});

test('the page carries the licences of all that it is made of', async () => {
  track = await startTrack([kDemo]);
  await open(track.address);
  await page.click('footer a');
  await page.waitForURL('**/licences.txt');
  const text = await page.textContent('body');
  const view = new URL('../../apps/view/', import.meta.url);
  const { dependencies, devDependencies } = JSON.parse(await readFile(new URL('package.json', view), 'utf8'));
  const served = Object.keys({ ...dependencies, ...devDependencies }).filter((name) => name !== 'esbuild');
  assert.ok(served.length >= 2);
  for (const name of served) {
    const licence = await readFile(new URL(`node_modules/${name}/LICENSE`, view), 'utf8');
    assert.ok(text.includes(licence.trim()), name);
  }
  assert.ok(text.includes('Redistribution and use in source and binary forms'), "the project's own");
});

test('the buttons pause, resume, reset, and save the mesh', async () => {
  track = await startTrack([kDemo]);
  await open(track.address);
  await untilTracking();
  await page.click('#pause');
  await untilBanner('Paused');
  // What was on its way has come by then.
  await page.waitForTimeout(500);
  const paused = await frame();
  await page.waitForTimeout(1500);
  assert.equal(await frame(), paused);
  await page.click('#pause');
  await untilBanner(null);
  await untilFrameAfter(paused);
  assert.equal(await valueOf('Restarts'), '0');
  await page.click('#reset');
  await until(() => document.querySelector('#values dd[data-name="Restarts"]').textContent === '1');
  await untilTracking();
  const [download] = await Promise.all([page.waitForEvent('download'), page.click('#save')]);
  await checkPly(await readFile(await download.path()));
  assert.match(download.suggestedFilename(), /^[\w-]+-frame-\d+\.ply$/);
  assert.deepEqual(complaints, []);
});

async function checkPly(bytes) {
  const end = bytes.indexOf('end_header\n') + 'end_header\n'.length;
  const header = bytes.subarray(0, end).toString();
  const vertices = Number(header.match(/element vertex (\d+)/)[1]);
  const faces = Number(header.match(/element face (\d+)/)[1]);
  assert.ok(vertices > 200 && faces > 300, header);
  assert.equal(bytes.length, end + vertices * 31 + faces * 13);
  for (let v = 0; v < vertices; v += 1) {
    const position = [0, 4, 8].map((at) => bytes.readFloatLE(end + 31 * v + at));
    assert.ok(position.every((value) => Math.abs(value) < 0.5), `vertex ${v} lies at ${position}`);
  }
  for (let f = 0; f < faces; f += 1) {
    const at = end + vertices * 31 + f * 13;
    assert.equal(bytes[at], 3);
    for (let i = 0; i < 3; i += 1) assert.ok(bytes.readInt32LE(at + 1 + 4 * i) < vertices);
  }
}

/** Two things that move, and what is known of them; the one that is nearer is tracked unless somebody chooses. */
function twoThings(folder) {
  const sensor = 'sim:box+bottle?motion=moderate&frames=6000&width=320&height=180&mask=none';
  return { sensor, ...truthOf(folder, sensor, { width: 320, height: 180 }, ['box', 'bottle']) };
}

/** Whether neither thing hides the other from a frame on, for so many. */
function areApart({ camera, poses }, from, count) {
  const kApart = 0.27; // Of the picture's width; the box is half as wide.
  const between = ({ box, bottle }) => Math.hypot(box.u - bottle.u, ((box.v - bottle.v) * camera.height) / camera.width);
  const places = (k) => ({ box: placeOf(poses.box[k].position, camera), bottle: placeOf(poses.bottle[k].position, camera) });
  for (let k = from; k < from + count; k += 1) if (between(places(k)) < kApart) return false;
  return true;
}

/** Waits until what was on its way has come: a frame that was being tracked when the run was paused, and results not yet drawn. */
async function untilStill() {
  for (let last = -1, now; (now = await frame()) !== last; last = now) await page.waitForTimeout(500);
}

/** Pauses the run at a frame from which on both things can be seen for a while. */
async function pauseWithBothInView(scene) {
  for (;;) {
    while (!areApart(scene, await frame(), 30)) await page.waitForTimeout(20);
    await page.click('#pause');
    await untilBanner('Paused');
    await untilStill();
    if (areApart(scene, await frame(), 8)) return;
    await page.click('#pause');
    await untilBanner(null);
  }
}

/**
 * Presses Choose and points at a thing as it is in the picture that is shown. While the run is paused, or on a busy machine the
 * thing would be elsewhere by then. @returns the frame shown.
 */
async function pointAt(scene, thing, { box_px = 0 } = {}) {
  const { camera, poses } = scene;
  await pauseWithBothInView(scene);
  await page.click('#choose');
  assert.equal(await page.getAttribute('#choose', 'aria-pressed'), 'true');
  await page.locator('#depth').scrollIntoViewIfNeeded();
  const picture = await page.locator('#depth').boundingBox();
  const shown = await frame();
  const { u, v } = placeOf(poses[thing][shown].position, camera);
  const [x, y] = [picture.x + u * picture.width, picture.y + v * picture.height];
  if (box_px === 0) {
    await page.mouse.click(x, y);
  } else {
    await page.mouse.move(x - box_px, y - box_px);
    await page.mouse.down();
    await page.mouse.move(x, y);
    await page.screenshot({ path: `${pictures}/choosing.png`, timeout: kPatience_ms });
    await page.mouse.move(x + box_px, y + box_px);
    await page.mouse.up();
  }
  assert.equal(await page.getAttribute('#choose', 'aria-pressed'), 'false');
  await page.click('#pause');
  await untilBanner(null);
  return shown;
}

/** Whether the first frame after the click begins the object anew, and its pose is true five frames after the click. */
function checkChosen(rows, { restarts, clicked, truth, wrong }) {
  const begin = rows.findIndex((row) => Number(row.reset_counter) === restarts);
  assert.ok(begin >= 0, `never begun for the ${restarts}. time`);
  const first = Number(rows[begin].frame);
  // The run was paused at the frame that was clicked in, and the page sends the choice before it sends that the run goes on: no frame
  // can be taken between the two.
  assert.equal(first - clicked, 1, 'frames from the one that was clicked in to the one that began it');
  const last = clicked + 5;
  const shown = rows.slice(begin, begin + last - first + 1);
  assert.ok(shown.every((row) => row.status === 'ok'), 'a frame has no pose');
  assert.equal(Number(shown.at(-1).frame), last);
  const said = [shown[0], shown.at(-1)].map(poseOf);
  const off = [truth, wrong].map((poses) => distance(said[0].position, poses[first].position).toFixed(3));
  assert.ok(distance(said[0].position, truth[first].position) < 0.1, `something else is tracked: ${off} m off, frame ${first}`);
  assert.ok(distance(said[0].position, wrong[first].position) > 0.1, 'what was tracked before still is');
  // Begun at every second of the 2108 frames of the 6000 from which on both things stay apart for the eight frames: at most 1.2 mm, and
  // 3.1 degrees (the bottle about its axis, of which the first images tell little).
  const error = errorOf(said, [truth[first], truth[last]]);
  assert.ok(error.position_m < 0.005 && error.angle_deg < 5, JSON.stringify(error));
}

test('who clicks another thing in the depth image has its true pose within five frames', async () => {
  const folder = mkdtempSync(join(tmpdir(), 'disflow-view-'));
  try {
    const scene = twoThings(folder);
    const csv = join(folder, 'run.csv');
    track = await startTrack([scene.sensor], { more: ['--csv', csv] });
    await open(track.address);
    await untilTracking();
    // Without the button a click does nothing.
    await page.click('#depth');
    const clicked = await pointAt(scene, 'bottle');
    await until(() => document.querySelector('#values dd[data-name="Restarts"]').textContent === '1');
    await untilTracking();
    await untilFrameAfter((await frame()) + 10);
    await page.click('#choose');
    await page.keyboard.press('Escape');
    assert.equal(await page.getAttribute('#choose', 'aria-pressed'), 'false');
    const drawn = await pointAt(scene, 'box', { box_px: 75 });
    await until(() => document.querySelector('#values dd[data-name="Restarts"]').textContent === '2');
    await untilFrameAfter((await frame()) + 10);
    await track.stop();
    const rows = rowsOf(csv);
    const { bottle, box } = scene.poses;
    checkChosen(rows, { restarts: 1, clicked, truth: bottle, wrong: box });
    checkChosen(rows, { restarts: 2, clicked: drawn, truth: box, wrong: bottle });
    assert.deepEqual(complaints, []);
  } finally {
    rmSync(folder, { recursive: true });
  }
});

test('of several objects the one that is shown is chosen anew, and the other goes on', async () => {
  const folder = mkdtempSync(join(tmpdir(), 'disflow-view-'));
  try {
    const scene = twoThings(folder);
    const { u, v } = placeOf(scene.poses.box[0].position, scene.camera);
    const seed = `${Math.round(u * 320)}:${Math.round(v * 180)}`;
    // Too small a region for anything to begin in.
    const nothing = 'name=other,roi=0:0:4:4';
    const more = ['--csv', join(folder, 'run.csv'), '--object', `name=one,seed=${seed}`, '--object', nothing];
    track = await startTrack([scene.sensor], { more });
    await open(track.address);
    await untilTracking();
    await page.click('#objects button:nth-child(2)');
    await until(() => document.getElementById('state').dataset.state === 'initialising');
    const clicked = await pointAt(scene, 'bottle');
    await untilTracking();
    await untilFrameAfter((await frame()) + 10);
    await track.stop();
    const [one, other] = ['one', 'other'].map((name) => rowsOf(join(folder, `run-${name}.csv`)));
    assert.ok(one.every((row) => row.status === 'ok' && row.reset_counter === '0'));
    const begin = other.findIndex((row) => row.status === 'ok');
    const { bottle, box } = scene.poses;
    // Nothing was there before.
    checkChosen(other.slice(begin), { restarts: Number(other[begin].reset_counter), clicked, truth: bottle, wrong: box });
    assert.deepEqual(complaints, []);
  } finally {
    rmSync(folder, { recursive: true });
  }
});

test('a setting that is entered holds from the next frame on, for all who look, and no other value is taken', async () => {
  const valueIn = (view, name) => view.inputValue(`input[name="${name}"]`);
  track = await startTrack([kDemo], { query: `?token=none` });
  await open(track.address);
  await untilTracking();
  await page.click('#settings summary');
  assert.equal(await valueIn(page, 'registration.iterations'), '8');
  assert.equal(await page.locator('input[name="field.cell_size_m"]').count(), 0);
  const other = await page.context().newPage();
  await other.goto(track.address);
  // A standard deviation that no pose has: the object is degraded from the next frame on.
  await page.fill('input[name="monitor.degraded_std_m"]', '0');
  await page.keyboard.press('Tab');
  await until(() => document.getElementById('state').dataset.state === 'degraded');
  await other.waitForFunction(() => document.querySelector('input[name="monitor.degraded_std_m"]')?.value === '0');
  // Out of its range it is not sent, and it may be corrected.
  await page.fill('input[name="registration.iterations"]', '99');
  await page.keyboard.press('Tab');
  assert.equal(await page.locator('#settings input:invalid').count(), 1);
  await page.fill('input[name="registration.iterations"]', '12');
  await page.keyboard.press('Tab');
  await other.waitForFunction(() => document.querySelector('input[name="registration.iterations"]').value === '12');
  // Each by itself may have its value, together they may not: who asked sees what holds.
  await page.fill('input[name="segmenter.min_range_m"]', '50');
  await page.keyboard.press('Tab');
  await until(() => document.querySelector('input[name="segmenter.min_range_m"]').value === '0.1');
  await page.locator('#settings').scrollIntoViewIfNeeded();
  await page.screenshot({ path: join(pictures, 'settings.png') });
  assert.equal(await valueOf('Restarts'), '0');
  assert.deepEqual(complaints, []);
});

test('a lost link is said, and comes back by itself after the program was started anew', async () => {
  track = await startTrack([kDemo], { more: kKnown });
  await open(`${track.url}?token=${kToken}`);
  await untilTracking();
  await untilFrameAfter(100);
  await track.stop();
  await untilBanner('Link lost');
  assert.ok(await page.isDisabled('#reset'));
  track = await startTrack([kDemo], { port: track.port, more: kKnown });
  await untilBanner(null);
  await until(() => Number(document.querySelector('#values dd[data-name="Frame"]').textContent) < 100);
  await untilTracking();
  // The browser itself says that nobody listened for a while.
  assert.deepEqual(complaints.filter((text) => !text.includes('ERR_CONNECTION_REFUSED')), []);
});

test('on a telephone nothing is cut off, in light and in dark', async () => {
  track = await startTrack([kDemo]);
  const grounds = new Set();
  for (const colorScheme of ['light', 'dark']) {
    await open(track.address, { viewport: { width: 390, height: 844 }, isMobile: true, hasTouch: true, colorScheme });
    await untilTracking();
    assert.ok(await page.evaluate(() => document.documentElement.scrollWidth <= innerWidth), 'it has to be scrolled sideways');
    for (const id of ['pause', 'reset', 'save']) {
      const box = await page.locator(`#${id}`).boundingBox();
      assert.ok(box.height >= 40 && box.width >= 60, `${id} is too small for a finger`);
    }
    grounds.add(await page.evaluate(() => getComputedStyle(document.body).backgroundColor));
    await page.screenshot({ path: `${pictures}/phone-${colorScheme}.png`, timeout: kPatience_ms });
    if (colorScheme === 'light') await page.context().close();
  }
  assert.equal(grounds.size, 2);
  assert.deepEqual(complaints, []);
});

test('the end of the input is said, and the page stays', async () => {
  track = await startTrack(['sim:box?frames=60'], { more: ['--view-hold'] });
  await open(track.address);
  await untilBanner('The input has ended');
  assert.equal(await frame(), 59);
  assert.deepEqual(complaints, []);
});

test('on this machine too only the printed address opens the page', async () => {
  track = await startTrack([kDemo]);
  assert.match(track.address, /\?token=[0-9a-f]{32}$/);
  assert.equal((await fetch(track.url)).status, 401);
  await open(track.address);
  await untilTracking();
  assert.equal(page.url(), track.url);
  assert.deepEqual(complaints, []);
});

test('with ?token=none whoever uses this machine sees the page', async () => {
  track = await startTrack([kDemo], { query: '?token=none' });
  assert.equal(track.address, track.url);
  assert.equal((await fetch(track.url)).status, 200);
});

test('with a token only who knows it sees the page', async () => {
  track = await startTrack([kDemo], { more: kKnown });
  const stranger = await fetch(track.url);
  assert.equal(stranger.status, 401);
  await open(`${track.url}?token=${kToken}`);
  await untilTracking();
  assert.equal(page.url(), track.url);
  assert.deepEqual(complaints, []);
});

// A name of 249 characters once made an Origin that was read as none. The browser finds all names below localhost here.
const kLongName = `${'a'.repeat(60)}.${'b'.repeat(60)}.${'c'.repeat(60)}.${'d'.repeat(56)}.localhost`;
const kRefused = { socket: 'refused', page: 'nothing', metrics: 'nothing', hidden: 'nothing' };

for (const [how, start] of [
  ['although the browser has the token', { more: kKnown }],
  ['although none is needed', { query: '?token=none' }],
]) {
  test(`pages of other sites get nothing, whatever their names, ${how}`, async () => {
    assert.equal(kLongName.length, 249);
    const site = await startSite();
    try {
      track = await startTrack([kDemo], start);
      await open(start.more ? `${track.url}?token=${kToken}` : track.url);
      await untilTracking();
      assert.equal((await page.evaluate(reach, track.url)).socket, 'opened', 'its own page reaches it');
      await until(() => document.querySelector('#values dd[data-name="Restarts"]').textContent === '1');
      // Of the same host, so that its requests carry the cookie, and of others.
      for (const name of ['127.0.0.1', 'localhost', 'another.localhost', kLongName]) {
        const foreign = await page.context().newPage();
        await foreign.goto(`http://${name}:${site.port}/`);
        assert.deepEqual(await foreign.evaluate(reach, track.url), kRefused, name);
        await foreign.close();
      }
      await untilFrameAfter((await frame()) + 5);
      assert.equal(await valueOf('Restarts'), '1');
      assert.deepEqual(complaints, []);
    } finally {
      site.stop();
    }
  });
}
