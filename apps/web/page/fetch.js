// Files of the page's folder, which lie there packed.

/** The bytes of a file of this folder, unpacked; tell(bytes so far) meanwhile. */
export async function bytes({ name, size }, tell) {
  const answer = await fetch(name);
  if (!answer.ok) throw new Error(`${name}: the server says ${answer.status}`);
  const parts = [];
  let have = 0;
  const reader = answer.body.getReader();
  for (;;) {
    const { done, value } = await reader.read();
    if (done) break;
    parts.push(value);
    have += value.length;
    tell(Math.min(have, size));
  }
  const packed = new Blob(parts);
  // Some servers unpack by themselves what ends in .gz.
  const [a, b] = new Uint8Array(await packed.slice(0, 2).arrayBuffer());
  if (a !== 0x1f || b !== 0x8b) return new Uint8Array(await packed.arrayBuffer());
  const unpacked = packed.stream().pipeThrough(new DecompressionStream("gzip"));
  return new Uint8Array(await new Response(unpacked).arrayBuffer());
}

/** A program of this folder, compiled. */
export const program = async (file, tell) => WebAssembly.compile(await bytes(file, tell));

/** A file in which first the first bytes of all words of four come, then the second, third and fourth ones. */
export function fromPlanes(planes) {
  const bytes = new Uint8Array(planes.length);
  let at = 0;
  for (let plane = 0; plane < 4; plane++) for (let to = plane; to < bytes.length; to += 4) bytes[to] = planes[at++];
  return bytes;
}
