"""The robot on the network as the server sees it: one page commands it, others watch and may stop it."""

import json

from pilotage.web.sessions import Client, Session

ENDS_WITHIN = 2.0
"""Time [s] in which a worker tells the wheels to stand before it is killed."""


class RobotSession(Session):
    """A robot and those who watch it; who came first has the command until the page is closed."""

    _watching: tuple[Client, ...] = ()  # in the order in which they came

    @property
    def commander(self) -> Client | None:
        """Who has the command."""
        return self._watching[0] if self._watching else None

    def join(self, client: Client) -> None:
        """Let a client watch, and command if nobody does."""
        super().join(client)
        self._watching += (client,)
        tell_command(client, holds=client is self.commander)

    def leave(self, client: Client) -> None:
        """Let a client go; if it had the command, the robot stands, and the next one has it."""
        super().leave(client)
        had_command = client is self.commander
        self._watching = tuple(one for one in self._watching if one is not client)
        if had_command:
            self._loop.run_in_executor(None, self.tell, {"type": "gone"})
        if had_command and self.commander is not None:
            tell_command(self.commander, holds=True)

    def refusal(self, kind: str, client: Client) -> str:
        """Say why a client may not do what it asks; everyone may stop the robot."""
        if kind == "stop" or client is self.commander:
            return ""
        return "another page commands this robot; here you can watch, and stop it"

    def end(self) -> None:
        """End the worker once the wheels were told to stand."""
        self.tell({"type": "end"})
        self._worker.process.join(ENDS_WITHIN)
        super().end()


def tell_command(client: Client, *, holds: bool) -> None:
    """Tell a client whether it has the command."""
    client.put("command", json.dumps({"v": 1, "type": "command", "holds": holds}))
