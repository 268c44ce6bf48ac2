// Numbers as a person reads them.
export const percent = (share: number) => `${Math.round(100 * share)} %`;
export const clock = (t: number) => `${Math.floor(t / 60)}:${String(Math.floor(t % 60)).padStart(2, "0")}`;
