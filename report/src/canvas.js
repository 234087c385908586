// Canvases of the curves live in main memory. They are small and drawn seldom, so a graphics card gains nothing there; and a browser
// without one would send each of them through an emulated card before the page appears (four-point beam: 3.5 s of processor time, not
// 1.3). uPlot asks for its contexts itself and takes no options, hence here.
const plain = HTMLCanvasElement.prototype.getContext;
HTMLCanvasElement.prototype.getContext = function (kind, options) {
  return plain.call(this, kind, kind === "2d" ? { willReadFrequently: true, ...options } : options);
};
