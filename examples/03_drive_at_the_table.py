"""Drive at a drawing table that runs already: `pilotage table --token TOKEN`, then this with the token.

Any drawing of the folder will do in place of the example; docs/reference/table-api.md explains the messages.
"""

import json
import sys
from urllib.request import Request, urlopen

from websockets.sync.client import connect

TOKEN = sys.argv[1] if len(sys.argv) > 1 else ""
PORT = sys.argv[2] if len(sys.argv) > 2 else "8765"
AUTHORIZED = {"Authorization": f"Bearer {TOKEN}"}

with urlopen(Request(f"http://127.0.0.1:{PORT}/api/worlds", headers=AUTHORIZED)) as answer:
    print("worlds:", ", ".join(world["id"] for world in json.load(answer)["worlds"]))

order = {"drawing": "example:office/quick", "world": "packed:office", "goal": "Ana", "speed": 20, "seed": 1}
with connect(f"ws://127.0.0.1:{PORT}/api/live", additional_headers=AUTHORIZED) as table:
    table.send(json.dumps({"v": 1, "type": "start", **order}))
    for message in map(json.loads, table):
        if message["type"] == "frame":
            print(f"{message['t']:6.1f} s  {message['text']}", end="   \r")
        elif message["type"] == "marks":
            print(f"{message['marks'][-1]['t']:6.1f} s  {message['marks'][-1]['text']}")
        elif message["type"] in ("done", "error"):
            print(message["text"])
            break
