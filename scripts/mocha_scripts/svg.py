"""What the pictures of the docs are drawn with. They have a ground of their own, so that they are legible on any page."""

BLUE, DARK, GREY, PALE = "#0b57a4", "#37474f", "#78909c", "#e3e8eb"


class Drawing:
    """Lines of SVG, the same for the same calls."""

    def __init__(self):
        self.lines = []

    def add(self, line):
        self.lines.append(line)

    def text(self, x, y, text, size=12, colour=DARK, anchor="start", weight="normal"):
        self.add(f'<text x="{x}" y="{y}" font-size="{size}" fill="{colour}" text-anchor="{anchor}" font-weight="{weight}">{text}</text>')

    def whole(self, width, height):
        head = (f'<svg xmlns="http://www.w3.org/2000/svg" width="{width}" height="{height}" viewBox="0 0 {width} {height}" '
                'font-family="DejaVu Sans, Verdana, sans-serif">')
        return "\n".join([head, f'<rect width="{width}" height="{height}" fill="#ffffff"/>', *self.lines, "</svg>"]) + "\n"
