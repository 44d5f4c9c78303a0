// SPDX-License-Identifier: Apache-2.0
// Requests from a page to the program, relative to the page's address.

const kinds = {
  f32: Float32Array, u32: Uint32Array, i32: Int32Array, i16: Int16Array, u16: Uint16Array, u8: Uint8Array,
};

/// Unpacks a binary answer: the length of a JSON header, the header, then the arrays that the header lists, each padded to
/// four bytes. If a name occurs in the header and among the arrays, the array is returned; `head` is the whole header.
export function unpack(buffer) {
  const length = new DataView(buffer).getUint32(0, true);
  const head = JSON.parse(new TextDecoder().decode(new Uint8Array(buffer, 4, length)));
  let at = 4 + length;
  const arrays = {};
  for (const { name, type, count } of head.arrays) {
    const Kind = kinds[type];
    if (!Kind) throw new Error(`an array of kind "${type}"`);
    arrays[name] = new Kind(buffer, at, count);
    at += 4 * Math.ceil((count * Kind.BYTES_PER_ELEMENT) / 4);
  }
  return { ...head, ...arrays, head };
}

async function answer(path, options) {
  let response;
  try {
    response = await fetch(`api/${path}`, options);
  } catch (error) {
    if (error.name === 'AbortError') throw error;
    throw new Error('the program does not answer: is crowdface still running?');
  }
  if (response.ok) return response;
  const told = await response.json().catch(() => null);
  const error = new Error(told?.error ?? `${path}: ${response.status} ${response.statusText}`);
  error.status = response.status;
  throw error;
}

export async function getJson(path) {
  return (await answer(path)).json();
}

export async function getBinary(path) {
  return unpack(await (await answer(path)).arrayBuffer());
}

function withBody(method, body, signal) {
  return {
    method, signal, headers: { 'Content-Type': 'application/json' }, body: JSON.stringify(body),
  };
}

export async function post(path, body) {
  const text = await (await answer(path, withBody('POST', body))).text();
  return text ? JSON.parse(text) : {};
}

export async function postForBinary(path, body, signal) {
  return unpack(await (await answer(path, withBody('POST', body, signal))).arrayBuffer());
}

export async function putBytes(path, bytes) {
  await answer(path, { method: 'PUT', headers: { 'Content-Type': 'application/octet-stream' }, body: bytes });
}

/// \param leaving  whether the page is being closed: the browser then still sends up to 64 kB
export async function put(path, body, leaving = false) {
  const options = withBody('PUT', body);
  const text = await (await answer(path, { ...options, keepalive: leaving && options.body.length < 60000 })).text();
  return text ? JSON.parse(text) : {};
}
