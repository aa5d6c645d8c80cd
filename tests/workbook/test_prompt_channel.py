"""A kernel's answers are sent at once: in JupyterLab, and where a demo is served."""

from __future__ import annotations

from jupyter_server.services.kernels.websocket import KernelWebsocketHandler
from traitlets.utils.importstring import import_item

from course.workbook.demos.full_screen import CHANNEL
from course.workbook.lab import options
from course.workbook.prompt_channel import PromptChannel


def test_both_servers_are_told_of_it(tmp_path):
    assert import_item(CHANNEL) is PromptChannel
    assert f"--ServerApp.kernel_websocket_connection_class={CHANNEL}" in options(
        tmp_path, None
    )


def test_nothing_waits_for_an_acknowledgement_before_a_message_is_passed_on(
    monkeypatch,
):
    done = []
    handler = KernelWebsocketHandler.__new__(KernelWebsocketHandler)
    handler.set_nodelay = lambda on: done.append(("nodelay", on))
    channel = PromptChannel.__new__(PromptChannel)
    channel.websocket_handler = handler
    monkeypatch.setattr(
        PromptChannel.__mro__[1],
        "handle_incoming_message",
        lambda self, message: done.append(("passed on", message)),
    )
    channel.handle_incoming_message(b"ask")
    assert done == [("nodelay", True), ("passed on", b"ask")]
