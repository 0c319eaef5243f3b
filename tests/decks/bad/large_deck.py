"""Writes a deck of 100 MB: a million elements, one by one, the last of which has a mistake."""
import sys

element = '    <element set="many" at="{} 0 0 mm" radius="1 mm" density="2000 kg/m^3"/> <!-- {} -->\n'
sys.stdout.write('<scene name="large">\n  <fill>\n')
for number in range(1000000):
    sys.stdout.write(element.format(2 * number, "." * 20))
sys.stdout.write('    <element set="many" at="0 1 0 mm" radius="1 m m" density="2000 kg/m^3"/>\n')
sys.stdout.write('  </fill>\n  <move><verlet time-step="1 us" until="10"/></move>\n</scene>\n')
