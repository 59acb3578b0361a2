/** Where the page's bundle is: beside it, within it (export --single-file), or in a walk that its address or the page names. */

import { decodedBase64, FolderSource, WalkSource, type Source } from './stream/source';

/** Elements of a page that holds its bundle: <script type="application/octet-stream" data-file="NAME">base64</script>. */
const elementOf = (file: string) => document.querySelector(`script[data-file="${CSS.escape(file)}"]`);

class WithinPage implements Source {
  text = async (file: string) => new TextDecoder().decode(this.bytes(file));
  url = () => undefined;
  from = () => undefined;
  bytes(file: string): Uint8Array {
    const element = elementOf(file);
    return element ? decodedBase64((element.textContent ?? '').trim()) : new Uint8Array(0);
  }
}

/** Of a page that was published with a walk beside it. */
const walkOfPage = () => document.querySelector<HTMLMetaElement>('meta[name="acentric-walk"]')?.content;

/** The walk that the page's address names (?walk=FILE), or else the page; or the bundle within the page or beside it. */
export async function sourceFor(index: string): Promise<Source> {
  const walk = new URLSearchParams(location.search).get('walk') ?? walkOfPage();
  if (walk !== undefined) return WalkSource.open(new URL(walk, document.baseURI).href);
  return elementOf(index) ? new WithinPage() : new FolderSource(document.baseURI);
}
