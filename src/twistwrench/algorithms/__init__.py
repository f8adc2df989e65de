"""The algorithms of the chapter (49.6 to 49.11), one file each, in its order.

Each file imports only from those above it in this table.

==============  =======  ==============================================================================
file            section  what it answers
==============  =======  ==============================================================================
_mimic                   a decorator: the function also takes a model whose joints follow others
terms                    what the recursions return: `RneaTerms`, `AbaTerms`, `CrbaTerms`, …
kinematics      49.6     where are the bodies, and how do they move: placements, twists, Jacobians
points          49.6     velocity, acceleration and Jacobian of a point given at run time
rnea            49.6     which forces make a motion happen
frame_wrench    49.6     the wrench through a weld: what a force-torque sensor reads
coriolis        49.6     the Coriolis matrix C
singular                 where is q̈ not determined: `refuse_singular` raises with the joint's name
aba             49.7     how does the robot accelerate
articulated     49.7     the articulated inertia of a body, by its name
crba            49.8     the mass matrix M
factorization   49.8     M = Lᵀ D L along the tree, and solves with it
inverse_mass    49.8     M⁻¹ without M
energy          49.8     kinetic and potential energy
floating_base   49.9     the selection matrix S, contact Jacobians J_c, static equilibrium
delassus        49.9     the inertia at a contact: Λ⁻¹ = J M⁻¹ Jᵀ, and Λ
centroidal      49.10    the centre of mass, the centroidal momentum h_G, its map A_G and its rate
momentum_rate   49.10    Ȧ_G, I_G, and velocity and acceleration of the centre of mass
subtree         49.10    mass, centre, Jacobian, inertia and momentum of a part of the robot
whole_body      49.11    M, h, J_c and A_G at once
mimic                    joints that follow others: a smaller model, projected
==============  =======  ==============================================================================

Import from the file: `from twistwrench.algorithms.aba import aba`. Most files have the name of their function.
"""
