// SPDX-License-Identifier: BSD-3-Clause
// The live view in a real browser: node --test view_test.mjs, with DISFLOW_TRACK, DISFLOW_CHROMIUM and a folder for pictures in
// DISFLOW_PICTURES.
import assert from 'node:assert/strict';
import { mkdirSync } from 'node:fs';
import { readFile } from 'node:fs/promises';
import { after, afterEach, before, beforeEach, test } from 'node:test';
import { chromium } from 'playwright-core';
import { startTrack } from './track.mjs';

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
