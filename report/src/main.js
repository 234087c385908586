// The page: reads its numbers and draws either the report of one run or the comparison of two.
import "./canvas.js";
import { readNumbers } from "./data.js";
import { element } from "./dom.js";
import { showReport } from "./report.js";
import { showComparison } from "./compare.js";

const page = document.getElementById("page");
const state = (window.fissura = { errors: [], ready: false });

/** When all that was asked for is on the page: curves are drawn in the next frame, the view in one after a change of size. */
state.settled = async () => {
  const frame = () => new Promise((done) => requestAnimationFrame(done));
  for (let i = 0; i < 3; ++i) await frame();
  while (state.view && state.view.asked !== state.view.drawn) await frame();
};

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
