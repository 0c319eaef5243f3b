"""Bounds of the stiffness of a solid with aligned fibres: Z. Hashin, Analysis of properties of fiber composites with anisotropic constituents,
J. Appl. Mech. 46 (1979) 543-550, for isotropic phases; the axial modulus and Poisson's ratio by the rule of mixtures."""


def transverse_modulus(fraction, E_m, nu_m, E_f, nu_f):
    """Lower and upper bound of Young's modulus across the fibres."""
    def bulk_and_shear(E, nu):
        mu = E / 2 / (1 + nu)
        return E / 3 / (1 - 2 * nu) + mu / 3, mu  # plane-strain bulk modulus

    def both(first, other, share):
        (k1, m1), (k2, m2) = first, other
        k = k1 + share / (1 / (k2 - k1) + (1 - share) / (k1 + m1))
        m = m1 + share / (1 / (m2 - m1) + (1 - share) * (k1 + 2 * m1) / (2 * m1 * (k1 + m1)))
        return k, m

    matrix, fibre = bulk_and_shear(E_m, nu_m), bulk_and_shear(E_f, nu_f)
    axial = fraction * E_f + (1 - fraction) * E_m
    nu = fraction * nu_f + (1 - fraction) * nu_m
    return [4 * k * m / (k + m * (1 + 4 * k * nu**2 / axial))
            for k, m in (both(matrix, fibre, fraction), both(fibre, matrix, 1 - fraction))]
