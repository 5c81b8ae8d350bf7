"""FTP and SFTP faces of a virtual controller."""
