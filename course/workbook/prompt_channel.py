"""The server's side of a kernel's web socket, without the wait that TCP has by itself."""

from __future__ import annotations

from typing import Any

from jupyter_server.services.kernels.connection.channels import (
    ZMQChannelsWebsocketConnection,
)


class PromptChannel(ZMQChannelsWebsocketConnection):
    """Jupyter's own, with Nagle's algorithm off (RFC 896).

    A kernel says that it is busy, and then what it found. With Nagle's algorithm the
    second message waits until the first is acknowledged, which a browser's system puts off
    by 40 ms: more than all the rest of a film's way.
    """

    def handle_incoming_message(self, incoming_msg: Any) -> None:
        """Pass a browser's message on; what is answered to it is sent at once."""
        # Not when it connects: the server turns the algorithm on after that.
        self.websocket_handler.set_nodelay(True)
        super().handle_incoming_message(incoming_msg)
