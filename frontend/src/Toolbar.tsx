// The buttons beside the sheet: tools of the drawing table, and what the pen draws.
import { COLOR, STYLES, STYLE_HINT, type Style } from "./scene";
import { Sign, TOOLS, type Tool } from "./Tools";

type Props = { tool: Tool; choose: (tool: Tool) => void; style: Style; setPen: (style: Style) => void };

export function Toolbar({ tool, choose, style, setPen }: Props) {
  return (
    <div className="own-tools" role="toolbar" aria-label="Tools of the drawing table">
      {TOOLS.map((one) => (
        <button key={one.tool} data-tool={one.tool} aria-pressed={tool === one.tool} title={one.hint} onClick={() => choose(tool === one.tool ? "none" : one.tool)}>
          <Sign name={one.sign} />
          <span>{one.text}</span>
        </button>
      ))}
      <hr />
      {STYLES.map((one) => (
        <button key={one} aria-pressed={style === one} title={STYLE_HINT[one] ?? `Draw ${one}, or make what is selected ${one}`} onClick={() => setPen(one)}>
          <i className="swatch" style={{ background: COLOR[one] }} />
          <span>{one}</span>
        </button>
      ))}
    </div>
  );
}
