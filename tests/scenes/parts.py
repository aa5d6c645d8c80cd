"""What several tests take from a scene."""


def bodies_and_contacts(scene):
    """The two that most functions of an impact ask for."""
    return scene.bodies, scene.contacts
