"""The drawing table: a local server for one page, on which a person draws a map and watches a robot use it.

The process that answers the page stays light: it knows files, tokens and websockets. All that reads a drawing
or drives a robot runs in worker processes. `docs/reference/table-api.md` is the protocol.
"""
