/** Messages over the picture: what cannot be had, and what to do. */

export class Messages {
  private readonly shown = new Map<string, HTMLElement>();

  constructor(private readonly list: HTMLElement) {}

  /** One of a name at a time. */
  show(name: string, text: string, action?: string, act?: () => void): void {
    this.hide(name);
    const message = document.createElement('div');
    message.className = 'message';
    message.dataset.name = name;
    const paragraph = document.createElement('p');
    paragraph.textContent = text;
    message.append(paragraph);
    const button = (label: string, press: () => void) => {
      const made = document.createElement('button');
      made.type = 'button';
      made.textContent = label;
      made.addEventListener('click', press);
      message.append(made);
    };
    if (action && act) button(action, act);
    button('Close', () => this.hide(name));
    this.list.append(message);
    this.shown.set(name, message);
  }

  hide(name: string): void {
    this.shown.get(name)?.remove();
    this.shown.delete(name);
  }

  /** Nothing can be shown. */
  fatal(text: string): void {
    const paragraph = document.createElement('p');
    paragraph.className = 'fatal';
    paragraph.setAttribute('role', 'alert');
    paragraph.textContent = text;
    document.querySelector('main')!.append(paragraph);
  }
}
