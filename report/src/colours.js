// Colours that are told apart by all: Okabe and Ito's for lines, maps that darken evenly for values.

export const LINES = ["#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9", "#6b5b95", "#8a8a8a"];

// Support points of inferno reversed, from where it leaves the paper's white, and of viridis.
const INFERNO = ["#fca50a", "#f37819", "#dd513a", "#bc3754", "#932667", "#6a176e", "#420a68", "#1b0c41", "#000004"];
const VIRIDIS = ["#440154", "#472d7b", "#3b528b", "#2c728e", "#21918c", "#28ae80", "#5ec962", "#addc30", "#fde725"];
const PIECES = ["#8f9aa6", "#6fa8d6", "#e39a5b", "#6fbf9b", "#c48bb0", "#d9b64a", "#84c3e6", "#9384b8", "#b0a08f"];
export const MODES = { 0: "#8a8a8a", 1: "#0072b2", 2: "#d55e00", 3: "#8c5aa6" };

function parts(hex) {
  const n = parseInt(hex.slice(1), 16);
  return [(n >> 16) / 255, ((n >> 8) & 255) / 255, (n & 255) / 255];
}

function ramp(colours) {
  const table = colours.map(parts);
  return (share) => {
    const t = Math.min(Math.max(share, 0), 1) * (table.length - 1);
    const i = Math.min(Math.floor(t), table.length - 2);
    return table[i].map((c, k) => c + (t - i) * (table[i + 1][k] - c));
  };
}

export const crackColour = ramp(INFERNO);
export const barColour = ramp(VIRIDIS);
export const pieceColour = (n) => parts(PIECES[n % PIECES.length]);
export const modeColour = (mode) => parts(MODES[mode] ?? MODES[0]);
export const css = ([r, g, b]) => `rgb(${Math.round(255 * r)} ${Math.round(255 * g)} ${Math.round(255 * b)})`;
export const gradient = (colour) => `linear-gradient(to right, ${Array.from({ length: 17 }, (_, i) => css(colour(i / 16))).join(",")})`;
