"""Keys that an editor offers in a bearing file, by the language server tombi: python packaging/completion.py

It needs tombi (pip install tombi) and ehlectric on the path. It writes a bearing file in a new folder, opens
it as an editor does, and prints what is offered after "radial_".
"""

import json
import subprocess
import tempfile
import time
from pathlib import Path
from typing import IO, Any


class Server:
    """Language server that speaks over its standard streams."""

    def __init__(self, words: list[str]) -> None:
        self.process = subprocess.Popen(words, stdin=subprocess.PIPE, stdout=subprocess.PIPE)
        assert self.process.stdin is not None
        assert self.process.stdout is not None
        self.write: IO[bytes] = self.process.stdin
        self.read: IO[bytes] = self.process.stdout

    def send(self, message: dict[str, Any]) -> None:
        """Send a message."""
        content = json.dumps({"jsonrpc": "2.0"} | message).encode()
        self.write.write(b"Content-Length: %d\r\n\r\n" % len(content) + content)
        self.write.flush()

    def answer(self, number: int) -> Any:
        """Result of a request; what the server asks meanwhile is answered with nothing."""
        while True:
            length = 0
            while line := self.read.readline().strip():
                if line.lower().startswith(b"content-length:"):
                    length = int(line.split(b":")[1])
            message = json.loads(self.read.read(length))
            if message.get("id") == number and "method" not in message:
                return message.get("result")
            if "id" in message and "method" in message:
                self.send({"id": message["id"], "result": None})


def main() -> None:
    """Print the keys that are offered."""
    with tempfile.TemporaryDirectory() as place:
        file = Path(place) / "bearing.toml"
        subprocess.run(["ehlectric", "init", file, "--kind", "bearing", "--quiet"], check=True)
        # Its first line names the schema.
        schema = file.read_text(encoding="utf-8").splitlines()[0]
        at, uri = 2, file.as_uri()
        text = f"{schema}\n[bearing]\nradial_\n"
        file.write_text(text, encoding="utf-8")
        server = Server(["tombi", "lsp"])
        root = {"rootUri": file.parent.as_uri(), "capabilities": {}, "processId": None}
        server.send({"id": 1, "method": "initialize", "params": root})
        server.answer(1)
        server.send({"method": "initialized", "params": {}})
        document = {"uri": uri, "languageId": "toml", "version": 1, "text": text}
        server.send({"method": "textDocument/didOpen", "params": {"textDocument": document}})
        place_of = {"textDocument": {"uri": uri}, "position": {"line": at, "character": len("radial_")}}
        # The server answers with nothing until it has read the schema.
        found: Any = []
        for number in range(2, 22):
            server.send({"id": number, "method": "textDocument/completion", "params": place_of})
            found = server.answer(number) or []
            if found:
                break
            time.sleep(0.5)
        for item in found["items"] if isinstance(found, dict) else found:
            print(item["label"], "-", item["documentation"]["value"].partition("\n")[0])
        server.process.kill()


if __name__ == "__main__":
    main()
