/** Where the bundle's files are: beside the page, or within it (export --single-file). */

export interface Source {
  text(file: string): Promise<string>;
  /** Absolute address of a file; undefined: `bytes` has it. */
  url(file: string): string | undefined;
  bytes(file: string): Uint8Array | undefined;
}

/** Elements of a page that holds its bundle: <script type="application/octet-stream" data-file="NAME">base64</script>. */
const elementOf = (file: string) => document.querySelector(`script[data-file="${CSS.escape(file)}"]`);

export function decodedBase64(base64: string): Uint8Array {
  const text = atob(base64);
  return Uint8Array.from({ length: text.length }, (_, i) => text.charCodeAt(i));
}

class WithinPage implements Source {
  text = async (file: string) => new TextDecoder().decode(this.bytes(file));
  url = () => undefined;
  bytes(file: string): Uint8Array {
    const element = elementOf(file);
    return element ? decodedBase64((element.textContent ?? '').trim()) : new Uint8Array(0);
  }
}

class BesidePage implements Source {
  async text(file: string): Promise<string> {
    let response: Response;
    try {
      response = await fetch(this.url(file));
    } catch {
      throw new Error(
        location.protocol === 'file:'
          ? `${file}: browsers do not let pages that are opened as files read others. Serve this folder with any web server, ` +
            'or export with --single-file.'
          : `${file}: the server does not answer`,
      );
    }
    if (!response.ok) throw new Error(`${file}: the server answers ${response.status}`);
    return response.text();
  }
  url = (file: string) => new URL(file, document.baseURI).href;
  bytes = () => undefined;
}

export const sourceFor = (index: string): Source => (elementOf(index) ? new WithinPage() : new BesidePage());
