"""The errors of the library as one exception."""


class Error(Exception):
    """An error of the library. Nothing has changed in the objects of the call.

    `code` is its name, "file_not_found"; `message` has the cause and the remedy; `element` is the kind of the elements
    concerned ("vertex", "edge", ...) or "", `ids` the first hundred of them from 0 (two vertices for an edge), and `count`
    their number.
    """

    def __init__(self, code, message, element="", ids=(), count=0):
        super().__init__(f"{message} [{code}]")
        self.code = code
        self.message = message
        self.element = element
        self.ids = list(ids)
        self.count = count
