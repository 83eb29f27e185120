// Tabs that assistive technology recognises: arrows, Home and End move, one panel shows.
import { make } from "./dom.js";

/** @returns {{add: (title: string) => object, current: object}} */
export function createTabs(list, panels, onChange) {
  const tabs = [];
  const view = { add, current: null };

  function add(title) {
    const id = title.toLowerCase();
    const button = make("button", { type: "button", role: "tab", id: `tab-${id}`, "aria-controls": `panel-${id}`, onclick: () => select(tab) }, title);
    const panel = make("div", { role: "tabpanel", id: `panel-${id}`, "aria-labelledby": `tab-${id}`, className: "panel" });
    const tab = { button, panel, state: (word) => (button.dataset.state = word) };
    button.addEventListener("keydown", (event) => move(event, tab));
    tabs.push(tab);
    list.append(button);
    panels.append(panel);
    if (!view.current) view.current = tab;
    show();
    return tab;
  }

  function move(event, tab) {
    const at = tabs.indexOf(tab);
    const to = { ArrowRight: at + 1, ArrowLeft: at - 1 + tabs.length, Home: 0, End: tabs.length - 1 }[event.key];
    if (to === undefined) return;
    event.preventDefault();
    const next = tabs[to % tabs.length];
    next.button.focus();
    select(next);
  }

  function select(tab) {
    view.current = tab;
    show();
    onChange(tab);
  }

  function show() {
    for (const tab of tabs) {
      const chosen = tab === view.current;
      tab.button.ariaSelected = String(chosen);
      tab.button.tabIndex = chosen ? 0 : -1;
      tab.panel.hidden = !chosen;
    }
  }

  return view;
}
