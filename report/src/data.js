// The numbers of the page: undoes src/fissura/report/blob.cpp.

const TYPES = { f4: Float32Array, u4: Uint32Array, u2: Uint16Array, i2: Int16Array, u1: Uint8Array };

function bytesOf(base64) {
  const text = atob(base64.trim());
  const bytes = new Uint8Array(text.length);
  for (let i = 0; i < text.length; ++i) bytes[i] = text.charCodeAt(i);
  return bytes;
}

async function inflate(bytes) {
  const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream("deflate"));
  return new Response(stream).arrayBuffer();
}

export class Numbers {
  constructor(buffer) {
    const length = new DataView(buffer).getUint32(0, true);
    const head = JSON.parse(new TextDecoder().decode(new Uint8Array(buffer, 4, length)));
    this.meta = head.meta;
    this.arrays = head.arrays;
    this.buffer = buffer;
    this.start = Math.ceil((4 + length) / 8) * 8;
  }

  has(name) {
    return name in this.arrays;
  }

  /** The array as it was written: a view, nothing is copied. */
  get(name) {
    const [type, offset, count] = this.arrays[name];
    return new TYPES[type](this.buffer, this.start + offset, count);
  }

  /** A quantised array: whole numbers and what one of them stands for. */
  scaled(name, scale) {
    return { values: this.get(name), scale };
  }
}

export async function readNumbers() {
  const element = document.getElementById("numbers");
  const buffer = await inflate(bytesOf(element.textContent));
  element.textContent = ""; // a copy of megabytes nobody needs any more
  return new Numbers(buffer);
}

/** A table of curves: columns by name. */
export class Curves {
  constructor(numbers, name) {
    const { rows, columns } = numbers.meta[name];
    this.rows = rows;
    this.columns = columns.map((c, i) => ({ ...c, values: numbers.get(`${name}/${i}`) }));
  }

  find(name) {
    return this.columns.find((c) => c.name === name);
  }

  values(name) {
    return this.find(name)?.values;
  }
}
