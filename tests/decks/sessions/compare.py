"""A comparison tells what differs, and nothing else, and by how much results do.   Usage: compare.py PAGE"""
import html
import re
import sys

page = open(sys.argv[1], encoding="utf-8").read()


def table_of(title):
    part = page[page.index(f">{title}</h2>") :]
    part = part[: part.index("</table>")]
    return {
        html.unescape(name): [html.unescape(re.sub("<[^>]*>", "", cell)) for cell in re.findall("<td>(.*?)</td>", cells)]
        for name, cells in re.findall("<tr><th>(.*?)</th>(.*?)</tr>", part.split("<tbody>")[1], re.S)
    }


assert re.search(r"<th></th><th>[^<]*a</th><th>[^<]*b</th><th>c/a</th>", page), re.findall("<th></th>.*?</tr>", page)[:1]
decks = table_of("What differs in their decks")
assert list(decks) == ["bond / cohesive-beam thick: young", "load / hold left: axes"], list(decks)
young = decks["bond / cohesive-beam thick: young"]
assert [float(value.split()[0]) for value in young] == [1e11, 5e10, 1e11], young
assert decks["load / hold left: axes"][2] == "x" and decks["load / hold left: axes"][0] == decks["load / hold left: axes"][1]
results = table_of("What came of them")
assert results["elements"] == ["3", "3", "3"], results["elements"]
assert results["breaks: axial"][:1] == ["1"], results
assert "%" in results["steps"][1], results["steps"]
