"""The network and its like: nothing is heard outside."""

from hostile.submission import attack

TCP = "import socket\ns = socket.socket()\n"
UDP = "import socket\ns = socket.socket(type=socket.SOCK_DGRAM)\n"
UNIX = "import socket\ns = socket.socket(socket.AF_UNIX)\n"
CTYPES = """
import ctypes, socket, struct
c = ctypes.CDLL(None)
n = c.socket(2, {kind}, 0)
a = struct.pack('<H', 2) + struct.pack('>H', {at}) + socket.inet_aton('127.0.0.1') + bytes(8)
"""
WAYS = {
    "connect": TCP + "s.connect(('127.0.0.1', {port}))\ns.send(b'{word}')",
    "connect-ex": TCP + "s.connect_ex(('127.0.0.1', {port}))\ns.send(b'{word}')",
    "create-connection": "import socket\n"
                         "socket.create_connection(('localhost', {port})).send(b'{word}')",
    "sendto": UDP + "s.sendto(b'{word}', ('127.0.0.1', {udp}))",
    "sendmsg": UDP + "s.sendmsg([b'{word}'], [], 0, ('127.0.0.1', {udp}))",
    "fast-open": TCP + "s.sendto(b'{word}', socket.MSG_FASTOPEN, ('127.0.0.1', {port}))",
    "dns-by-hand": UDP + "q = b'\\0\\1\\1\\0\\0\\1' + bytes(6)\nfor p in '{word}'.split('.'):\n"
                   "    q += bytes([len(p)]) + p.encode()\n"
                   "s.sendmsg([q + b'\\0\\0\\1\\0\\1'], [], 0, ('127.0.0.1', {udp}))",
    "urllib": "import urllib.request\n"
              "urllib.request.urlopen('http://127.0.0.1:{port}/{word}', timeout=1)",
    "http-client": "import http.client\nh = http.client.HTTPConnection('127.0.0.1', {port}, "
                   "timeout=1)\nh.request('GET', '/{word}')",
    "numpy-datasource": "np.lib.npyio.DataSource('.').open('http://127.0.0.1:{port}/{word}')",
    "asyncio": "import asyncio\nasync def m():\n    r, w = await asyncio.open_connection("
               "'127.0.0.1', {port})\n    w.write(b'{word}')\n    await w.drain()\n"
               "asyncio.run(m())",
    "unix": UNIX + "s.connect('{unix}')\ns.send(b'{word}')",
    "unix-by-dir": "import os\nos.chdir('{home}')\n" + UNIX
                   + "s.connect('socket')\ns.send(b'{word}')",
    "unix-datagram": "import socket\ns = socket.socket(socket.AF_UNIX, socket.SOCK_DGRAM)\n"
                     "s.sendmsg([b'{word}'], [], 0, '{unix}-datagram')",
    "abstract": UNIX + "s.connect('\\0{abstract}')\ns.send(b'{word}')",
    "abstract-datagram": "import socket\n"
                         "s = socket.socket(socket.AF_UNIX, socket.SOCK_DGRAM)\n"
                         "s.sendmsg([b'{word}'], [], 0, '\\0{abstract}-datagram')",
    "raw-socket-module": "import _socket\ns = _socket.socket(_socket.AF_INET, "
                         "_socket.SOCK_STREAM)\ns.connect(('127.0.0.1', {port}))\n"
                         "s.send(b'{word}')",
    "ctypes-connect": CTYPES.replace("{kind}", "1").replace("{at}", "{port}")
                      + "c.connect(n, a, 16)\nc.write(n, b'{word}', len('{word}'))",
    "ctypes-sendto": CTYPES.replace("{kind}", "2").replace("{at}", "{udp}")
                     + "c.sendto(n, b'{word}', len('{word}'), 0, a, 16)",
    "multiprocessing-client": "from multiprocessing.connection import Client\n"
                              "Client(('127.0.0.1', {port})).send_bytes(b'{word}')",
    "logging-handler": "import logging.handlers as h, logging\n"
                       "h.DatagramHandler('127.0.0.1', {udp}).send(b'{word}')",
    "syslog-handler": "import logging.handlers as h, logging\n"
                      "h.SysLogHandler(('127.0.0.1', {udp})).emit("
                      "logging.makeLogRecord({'msg': '{word}'}))",
    "thread": "import threading, socket\ndef f():\n    s = socket.socket()\n"
              "    s.connect(('127.0.0.1', {port}))\n    s.send(b'{word}')\n"
              "t = threading.Thread(target=f)\nt.start()\nt.join()",
    "io-uring": "import ctypes\nc = ctypes.CDLL(None, use_errno=True)\n"
                "p = (ctypes.c_uint32 * 30)()\n"
                "if c.syscall(425, 4, p) < 0: raise OSError(ctypes.get_errno())\n"
                "raise RuntimeError('{won}')",
    "vsock": "import socket\ns = socket.socket(socket.AF_VSOCK)\ns.settimeout(0.3)\n"
             "s.connect((1, {port}))\ns.send(b'{word}')",
    "netlink": "import socket\ns = socket.socket(socket.AF_NETLINK, socket.SOCK_RAW, 0)\n"
               "s.bind((0, 0))\ns.close()",
}  # fmt: skip
PROBES = {"vsock", "netlink"}
SAMPLE = {"connect", "sendmsg", "unix", "abstract"}

HARMS = dict.fromkeys(PROBES, "mark") | {"io-uring": "told"}

FAMILY = [
    attack(
        f"network-{name}",
        code,
        HARMS.get(name, "heard"),
        sample=name in SAMPLE,
        works_bare=name not in PROBES,
    )
    for name, code in WAYS.items()
]
