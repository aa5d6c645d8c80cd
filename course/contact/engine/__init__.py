"""What makes ``solve(method="auto")`` fast and sure, from the methods of ``solvers`` up.

It imports ``course.contact.solvers``, which imports nothing from here.

file               the question it answers                         when "auto" uses it
methods            which method does a word name?                  always: "auto" is one of them
automatic          whole, or by islands?                           always
acceptance         is this force to be believed?                   after every method
refusals           what is said where nothing is to be found?      A indefinite; no force; not converged
block_pivots       who pushes, of up to 128 contacts?              first, for every small island
batch_pivots       the same of many small systems (compiled)       for batches, and islands of like size
islands            which contacts depend on each other?            beyond 128 contacts, or in doubt
interior_point     forces of a large island, by accelerations?     first, for every large island
active_set         forces to rounding, once it is clear who pushes?  at the end of interior_point and of the QP
fallbacks          what if the first method is in doubt?           island by island, the rest of this list
exact              what do the stored numbers say, unrounded?      in doubt, up to 40 contacts
certificates       is there a proof that no force exists?          in doubt, or where forces run away
least_distance     forces by least squares for any A and b?        in doubt, up to 1,000 contacts
scaling            the system with a diagonal of ones              under interior_point and active_set
mass_weighting     G' = J M^-1/2, whose rows give A = G'G          for elimination by accelerations, and proofs
regularization     how is (A + diag(1/theta)) x = q solved?        in every Newton step; picks the cheapest of
banded_cholesky      for long things: stacks, walls, chains
sparse_cholesky      for wide ones: piles
"""
