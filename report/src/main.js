// The page: reads its numbers and draws either the report of one run or the comparison of two.
import "./canvas.js";
import { readNumbers } from "./data.js";
import { element } from "./dom.js";
import { showReport } from "./report.js";
import { showComparison } from "./compare.js";

const page = document.getElementById("page");
const state = (window.fissura = { errors: [], ready: false });

function complain(text) {
  state.errors.push(text);
  document.querySelector(".loading")?.remove();
  page.prepend(element("p.problem", "This page could not draw everything: ", text));
}

window.addEventListener("error", (event) => complain(event.message));
window.addEventListener("unhandledrejection", (event) => complain(String(event.reason?.message ?? event.reason)));

readNumbers().then((numbers) => {
  page.replaceChildren();
  (numbers.meta.kind === "comparison" ? showComparison : showReport)(page, numbers, state);
  state.ready = true;
  state.seconds = performance.now() / 1000;
});
