! rule: of a file with two modules the first is read
! source: [K §9] modules are loaded one by one or as a group; nothing says how a file holds a group
MODULE Demo
ENDMODULE
MODULE Other  ! -> RG217?
ENDMODULE
