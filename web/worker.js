// A worker: it holds the program and answers one call at a time.

let program = null;

const heap = () => program.memory.buffer;

/** The answer to a call: its JSON, and its lists as views of one array of numbers. */
function answer(name, scene, from, to) {
  const call = new TextEncoder().encode(name);
  const text = new TextEncoder().encode(scene);
  const bytes = call.length + text.length;
  const place = program.allocate(bytes);
  new Uint8Array(heap(), place, call.length).set(call);
  new Uint8Array(heap(), place + call.length, text.length).set(text);
  const head = program.call(place, bytes, call.length, from, to);
  const [json, length, numbers, count] = new Uint32Array(heap(), head, 4);
  const found = JSON.parse(new TextDecoder().decode(new Uint8Array(heap(), json, length)));
  const list = new Float64Array(heap(), count ? numbers : 0, count).slice();
  program.release(head);
  return { found, list };
}

self.onmessage = async ({ data }) => {
  if (data.module) {
    program = (await WebAssembly.instantiate(data.module, {})).exports;
    self.postMessage({ ready: true });
    return;
  }
  try {
    const { found, list } = answer(data.name, data.scene, data.from, data.to);
    self.postMessage({ id: data.id, found, list }, [list.buffer]);
  } catch (fault) {
    // a trap leaves the program in no known state: the page starts another worker
    self.postMessage({ id: data.id, fault: String(fault) });
  }
};
