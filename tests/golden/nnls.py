"""Writes nnls.csv: least squares with non-negative unknowns by scipy.optimize.nnls.

Matrices: uniform numbers, and exp(-0.35 (i - j)^2) with columns that resemble their neighbours.
Right sides have noise, so that some unknowns end at zero.
"""

import numpy as np
from scipy.optimize import nnls


def main():
    random = np.random.default_rng(50)
    with open("nnls.csv", "w", encoding="utf-8") as file:
        file.write("problem,kind,values\n")
        for problem, (rows, columns) in enumerate([(6, 3), (12, 8), (40, 12), (60, 20), (30, 30)]):
            if problem in (1, 3):
                i, j = np.meshgrid(np.arange(rows) * columns / rows, np.arange(columns), indexing="ij")
                matrix = np.exp(-((i - j) ** 2) * 0.35)
            else:
                matrix = random.uniform(-1, 1, (rows, columns))
            truth = np.maximum(random.normal(size=columns), 0)
            right = np.round(matrix @ truth + 0.2 * random.normal(size=rows), 6)
            matrix = np.round(matrix, 6)
            found, _ = nnls(matrix, right)
            for row in matrix:
                file.write(f"{problem},row,{' '.join(f'{x:g}' for x in row)}\n")
            file.write(f"{problem},right,{' '.join(f'{x:.10g}' for x in right)}\n")
            file.write(f"{problem},solution,{' '.join(f'{x:.15g}' for x in found)}\n")


if __name__ == "__main__":
    main()
