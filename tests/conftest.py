"""For all tests: what a shell's background job or ``nohup`` ignores is what a terminal's does not."""

import signal

for name, usual in (
    ("SIGINT", signal.default_int_handler),
    ("SIGHUP", signal.SIG_DFL),
):
    number = getattr(signal, name, None)
    # Tests of Ctrl-C and of closed terminals start processes, which inherit what is ignored.
    if number and signal.getsignal(number) is signal.SIG_IGN:
        signal.signal(number, usual)
