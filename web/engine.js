// The workers, and the calls that wait for one.

/** The program as a compiled module, from the text that scripts/page puts into the page. */
export async function compiled() {
  const packed = Uint8Array.from(atob(document.getElementById("program").textContent.trim()), (c) => c.charCodeAt(0));
  const unpacked = new Blob([packed]).stream().pipeThrough(new DecompressionStream("gzip"));
  return WebAssembly.compile(await new Response(unpacked).arrayBuffer());
}

/** Some workers for calls of several kinds: a new job of a kind makes the calls of the one before void. */
export class Engine {
  constructor(module, workers) {
    this.module = module;
    this.waiting = [];
    this.idle = [];
    this.running = new Map();
    this.jobs = {};
    this.next = 0;
    const code = document.getElementById("worker").textContent;
    this.code = URL.createObjectURL(new Blob([code], { type: "text/javascript" }));
    for (let i = 0; i < workers; i += 1) this.start();
  }

  start() {
    const worker = new Worker(this.code);
    worker.onmessage = ({ data }) => this.heard(worker, data);
    this.module.then((module) => worker.postMessage({ module }));
  }

  heard(worker, data) {
    const call = this.running.get(data.id);
    this.running.delete(data.id);
    if (data.fault) {
      worker.terminate();
      this.start();
      const message = `The program failed: ${data.fault}. Please report the address of this page.`;
      call?.done({ error: { message } });
      return;
    }
    this.idle.push(worker);
    if (call && this.isWanted(call)) {
      const { found, list } = data;
      found.lists = Object.fromEntries(
        Object.entries(found.lists).map(([name, [first, length]]) => [name, list.subarray(first, first + length)]),
      );
      call.done(found);
    }
    this.go();
  }

  isWanted(call) {
    return this.jobs[call.kind] === call.job;
  }

  go() {
    this.waiting = this.waiting.filter((call) => this.isWanted(call));
    while (this.waiting.length > 0 && this.idle.length > 0) {
      const call = this.waiting.shift();
      const id = (this.next += 1);
      this.running.set(id, call);
      this.idle.pop().postMessage({ id, name: call.name, scene: call.scene, from: call.from, to: call.to });
    }
  }

  /** Begins a job of a kind: calls of earlier ones are dropped, and their answers are not heard. */
  begin(kind) {
    this.jobs[kind] = (this.jobs[kind] ?? 0) + 1;
    return this.jobs[kind];
  }

  /** The answer to a call; it never comes if its job is no longer the latest of its kind. */
  ask(kind, name, scene, from = 0, to = 0) {
    const job = this.jobs[kind];
    return new Promise((done) => {
      this.waiting.push({ kind, job, name, scene, from, to, done });
      this.go();
    });
  }
}
